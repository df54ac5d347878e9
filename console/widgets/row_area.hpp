// A list of rows that scrolls, and shows a row whole or not at all.
#pragma once

#include <QScrollArea>

namespace console {

/// The rows are what the layout of its widget holds. It takes no focus itself: it follows that of what is in it.
class RowArea : public QScrollArea {
    Q_OBJECT
public:
    RowArea(const QString& accessibleName, QWidget* parent);

protected:
    void resizeEvent(QResizeEvent* event) override;
    void scrollContentsBy(int dx, int dy) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void showRowOf(QWidget* inside);
    void coverWhatIsCut();

    QWidget* m_above;
    QWidget* m_below;
};

} // namespace console
