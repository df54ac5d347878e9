// Ctrl+,: what a person sets up for themselves, each entry with what it does.
#pragma once

#include "model/preferences.hpp"

#include <QFrame>

class QLabel;
class QLineEdit;
class QVBoxLayout;

namespace console {

class ChoiceRow;
class SheetButton;

/// Shows and asks; whoever owns the preferences decides. While it is read-only it can be looked at and says why.
class PreferencesView : public QFrame {
    Q_OBJECT
public:
    explicit PreferencesView(QWidget* parent = nullptr);

    void setPreferences(const Preferences& preferences);

    /// Empty: everything can be changed.
    void setReadOnly(const QString& why);

    /// Entries that the command line decides for this run, as words; empty: none.
    void setOverruled(const QString& words);

    /// How keeping the last change ended; empty: well.
    void showTrouble(const QString& trouble);

Q_SIGNALS:
    void changed(const console::Preferences& wanted);
    void aboutRequested();
    void leaveRequested();

private:
    QWidget* makeEntries();
    void makeHead(QVBoxLayout* column);
    void makeFoot(QVBoxLayout* column);
    ChoiceRow* addChoice(QVBoxLayout* column, const QString& name, const QString& whatItDoes, const QStringList& choices);
    void addGeneral(QVBoxLayout* column);
    void addPictures(QVBoxLayout* column);
    void addHold(QVBoxLayout* column);
    void addLengths(QVBoxLayout* column);
    void takeTableTop();
    QLineEdit* addText(QVBoxLayout* column, const QString& name, const QString& whatItDoes, const QString& whenEmpty, int mostLetters);
    template <typename Change>
    void ask(Change change);

    Preferences m_preferences;
    SheetButton* m_leave;
    SheetButton* m_about;
    SheetButton* m_defaults;
    QLabel* m_state;
    QLabel* m_overruled;
    ChoiceRow* m_language = nullptr;
    ChoiceRow* m_brightness = nullptr;
    ChoiceRow* m_pause = nullptr;
    ChoiceRow* m_span = nullptr;
    ChoiceRow* m_window = nullptr;
    ChoiceRow* m_noise = nullptr;
    ChoiceRow* m_edge = nullptr;
    ChoiceRow* m_edgeMethod = nullptr;
    ChoiceRow* m_rate = nullptr;
    ChoiceRow* m_hold = nullptr;
    ChoiceRow* m_object = nullptr;
    QLineEdit* m_folder = nullptr;
    QLineEdit* m_patientSide = nullptr;
    QLineEdit* m_tableTop = nullptr;
    bool m_readOnly = false;
};

} // namespace console
