// One setting: its name, what it does, and its few values side by side.
#pragma once

#include <QWidget>

#include <vector>

class QLabel;

namespace console {

class SheetButton;

/// No list drops down: that would take Esc, which is the emergency stop, for itself. The value in force is marked by its button and said in
/// words, so that one that has no button is seen, too.
class ChoiceRow : public QWidget {
    Q_OBJECT
public:
    ChoiceRow(const QString& name, const QString& whatItDoes, const QStringList& choices, QWidget* parent = nullptr);

    /// `choice`: which button stands for it, -1 for none.
    void setValue(int choice, const QString& words);
    int value() const { return m_value; }

    /// It can be looked at and not changed.
    void setReadOnly(bool readOnly);

    const std::vector<SheetButton*>& buttons() const { return m_buttons; }

Q_SIGNALS:
    void chosen(int choice);

private:
    int m_value = -1;
    QLabel* m_words;
    std::vector<SheetButton*> m_buttons;
};

} // namespace console
