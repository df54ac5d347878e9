// The lines of a log, each in three columns: time, kind, text.
#pragma once

#include <QListView>
#include <QPersistentModelIndex>

namespace console {

/// Follows the newest line while the newest is in view and none is marked. Enter and a double click choose a line; keys that are nobody's
/// here go on to the window.
class LogLines : public QListView {
    Q_OBJECT
public:
    explicit LogLines(QWidget* parent = nullptr);

    void setModel(QAbstractItemModel* model) override;

    /// The line that has the mark before it; invalid: none has.
    void mark(const QModelIndex& line);
    const QPersistentModelIndex& marked() const { return m_marked; }

    /// Scrolls as far as it takes.
    void bringMarkIntoView();

Q_SIGNALS:
    void chosen(const QModelIndex& line);

protected:
    void changeEvent(QEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void rowsInserted(const QModelIndex& parent, int start, int end) override;
    void rowsAboutToBeRemoved(const QModelIndex& parent, int start, int end) override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;

private:
    bool atNewest() const;
    void showWholeLines();

    bool m_follows = true;
    QPersistentModelIndex m_marked;
};

} // namespace console
