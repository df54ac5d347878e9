// The buttons of the alarm self-test.
#include "widgets/self_test_block.hpp"

#include "widgets/focus_return.hpp"
#include "widgets/theme.hpp"
#include "widgets/touch_button.hpp"

#include <QHBoxLayout>

namespace console {

SelfTestBlock::SelfTestBlock(QWidget* parent)
    : QWidget(parent),
      m_begin(add(tr("Alarm self-test (F8)"), tr("Begin the alarm self-test: three colours and three sounds"))),
      m_right(add({}, tr("All three alarm colours were seen, and the sounds heard"))),
      m_wrong(add(tr("Test not right"), tr("An alarm colour or a sound was missing")))
{
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(8);
    for (QPushButton* button : {m_begin, m_right, m_wrong})
        row->addWidget(button);
    connect(m_begin, &QPushButton::clicked, this, &SelfTestBlock::beginRequested);
    connect(m_right, &QPushButton::clicked, this, [this] { Q_EMIT answered(true); });
    connect(m_wrong, &QPushButton::clicked, this, [this] { Q_EMIT answered(false); });
    setStep(AlarmSelfTest::Step::NotDone);
    setSoundWorks(true);
}

void SelfTestBlock::setSoundWorks(bool works) { m_right->setText(works ? tr("Test seen and heard") : tr("Test seen; no sound here")); }

void SelfTestBlock::setMayBegin(bool may)
{
    if (!may)
        returnFocus(m_begin);
    m_begin->setEnabled(may);
}

QPushButton* SelfTestBlock::add(const QString& text, const QString& accessibleName)
{
    auto* button = new TouchButton(text, this);
    theme::setTextRole(button, theme::TextRole::Strong);
    button->setAccessibleName(accessibleName);
    button->setAutoDefault(false);
    button->setFocusPolicy(Qt::TabFocus); // a click leaves the keys with the hand
    button->setProperty("compact", true);
    button->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
    return button;
}

void SelfTestBlock::setStep(AlarmSelfTest::Step step)
{
    using Step = AlarmSelfTest::Step;
    const auto show = [](QPushButton* button, bool shown) {
        if (!shown)
            returnFocus(button);
        button->setVisible(shown);
    };
    show(m_begin, step == Step::NotDone || step == Step::Failed);
    show(m_right, step == Step::Asking);
    show(m_wrong, step == Step::Asking);
    setVisible(m_begin->isVisibleTo(this) || m_right->isVisibleTo(this));
}

} // namespace console
