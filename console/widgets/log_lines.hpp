// The lines of a log, each in three columns: time, kind, text.
#pragma once

#include <QListView>

namespace console {

/// Follows the newest line while the newest is in view. Keys that are nobody's here go on to the window.
class LogLines : public QListView {
    Q_OBJECT
public:
    explicit LogLines(QWidget* parent = nullptr);

    void setModel(QAbstractItemModel* model) override;

protected:
    void changeEvent(QEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void rowsInserted(const QModelIndex& parent, int start, int end) override;
    void rowsAboutToBeRemoved(const QModelIndex& parent, int start, int end) override;
    void showEvent(QShowEvent* event) override;

private:
    bool atNewest() const;

    bool m_follows = true;
};

} // namespace console
