// F7: which picture stands beside the live one, what is on further screens, and the layouts that were saved.
#pragma once

#include "model/screen_plan.hpp"

#include <QFrame>
#include <QStringList>

class QLabel;
class QLineEdit;
class QVBoxLayout;

namespace console {

class RowArea;
class SheetButton;

/// Shows and asks; the composition root does it.
class ScreensView : public QFrame {
    Q_OBJECT
public:
    struct State {
        Arrangement arrangement = Arrangement::Usual;
        QString cockpit;     ///< the screen with the cockpit
        QStringList further; ///< the others that are there
        QString second;      ///< empty: none
        QString third;
        QStringList layouts;
        QString fixed; ///< why screens and layouts cannot be changed now; empty: they can

        bool operator==(const State&) const = default;
    };

    explicit ScreensView(QWidget* parent = nullptr);

    void showState(const State& state);

    /// What became of the last wish.
    void say(const QString& words);

Q_SIGNALS:
    void arrangementChosen(console::Arrangement arrangement);
    void secondChosen(const QString& screen);
    void thirdChosen(const QString& screen);
    void saveRequested(const QString& name);
    void restoreRequested(int place);
    void deleteRequested(int place);
    void leaveRequested();

private:
    void rebuild();
    void addScreens(QVBoxLayout* column);
    void addLayouts(QVBoxLayout* column);
    void makeSaving(QVBoxLayout* column);
    void save();

    State m_state;
    SheetButton* m_leave;
    SheetButton* m_save;
    QLineEdit* m_name;
    QLabel* m_words;
    RowArea* m_area;
    QWidget* m_body = nullptr;
};

} // namespace console
