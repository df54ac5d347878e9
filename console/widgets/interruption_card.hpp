// "While you were away": the account of an interruption, and the button with which a person says that it was read.
#pragma once

#include "model/interruption.hpp"

#include <QFrame>

class QGridLayout;
class QLabel;

namespace console {

class SheetButton;

/// Docked like the diagnosis sheet and not modal. It is shown while an account is unread and goes only when that was acknowledged; it takes
/// the focus from nobody. Enter acknowledges nothing, and the button works from InterruptionAccount::readTime on.
class InterruptionCard : public QFrame {
    Q_OBJECT
public:
    explicit InterruptionCard(const InterruptionAccount& account, QWidget* parent = nullptr);

    void refresh(Instant now);
    QWidget* readButton() const;

Q_SIGNALS:
    void readRequested();

private:
    QWidget* makeBody();
    void setLines(const QString& headline, const std::vector<AccountLine>& lines);

    const InterruptionAccount& m_account;
    QLabel* m_headline;
    QLabel* m_notice;
    QGridLayout* m_grid = nullptr;
    SheetButton* m_read;
    std::vector<std::pair<QLabel*, QLabel*>> m_rows;
    std::vector<AccountLine> m_shown;
};

} // namespace console
