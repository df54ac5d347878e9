// One chip for each master that is there.
#include "widgets/master_row.hpp"

#include "widgets/enter_key.hpp"
#include "widgets/figures.hpp"
#include "widgets/focus_return.hpp"
#include "widgets/theme.hpp"

#include <QHBoxLayout>
#include <QPainter>

#include <algorithm>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

constexpr double widestName = 320; ///< at the reference; what a device calls itself can be long

bool lost(MasterLife life) { return life == MasterLife::Gone || life == MasterLife::Silent; }

QString lifeWords(const MasterStatus& status, Instant now)
{
    const auto life = word(status.life);
    return lost(status.life) && status.inUse ? MasterRow::tr("%1 for %2").arg(life, spokenAge(now - status.since)) : life;
}

} // namespace

MasterChip::MasterChip(QWidget* parent) : QAbstractButton(parent)
{
    setFocusPolicy(Qt::TabFocus);
    theme::setTextRole(this, TextRole::Caption);
}

void MasterChip::setStatus(const MasterStatus& status, const QString& words)
{
    if (m_status == status && m_words == words)
        return;
    const auto before = sizeHint();
    m_status = status;
    m_words = words;
    setAccessibleName(status.inUse ? tr("Master in use: %1, %2").arg(status.name, words) : tr("Use %1, %2").arg(status.name, words));
    setAccessibleDescription(status.note);
    setToolTip(status.note);
    if (sizeHint() != before)
        updateGeometry();
    update();
}

QString MasterChip::name() const
{
    return QFontMetrics(font()).elidedText(m_status.name, Qt::ElideRight, theme::px(this, widestName)) + QLatin1Char(':');
}

QSize MasterChip::sizeHint() const
{
    const QFontMetrics metrics(font());
    const int least = theme::touchSide(this);
    const int width = metrics.height() + metrics.horizontalAdvance(name()) + int(figuresWidth(font(), m_words)) + theme::px(this, 34);
    return {std::max(width, least), std::max(metrics.height() + theme::px(this, 6), least)};
}

void MasterChip::paintMark(QPainter& painter, const QRectF& where) const
{
    const QColor ink = m_status.inUse ? colour::bright : colour::secondary;
    painter.setPen(QPen(ink, 1.6, m_status.life == MasterLife::Unheard ? Qt::DashLine : Qt::SolidLine));
    painter.setBrush(m_status.life == MasterLife::Alive ? QBrush(ink) : QBrush(Qt::NoBrush));
    painter.drawEllipse(where);
    if (!lost(m_status.life))
        return;
    painter.drawLine(where.topLeft(), where.bottomRight());
    painter.drawLine(where.topRight(), where.bottomLeft());
}

void MasterChip::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF box = QRectF(rect()).adjusted(1, 1, -1, -1);
    if (m_status.inUse || hasFocus() || (underMouse() && isEnabled())) {
        painter.setPen(QPen(hasFocus() ? colour::focus : m_status.inUse ? colour::strongLine : colour::line, hasFocus() ? 2.0 : 1.2));
        painter.setBrush(m_status.inUse ? colour::raised : colour::panel);
        painter.drawRoundedRect(box, 4, 4);
    }
    const double side = QFontMetricsF(font()).height() * 0.75;
    const double pad = theme::px(this, 8);
    paintMark(painter, QRectF(box.left() + pad, box.center().y() - side / 2, side, side));
    const QFontMetricsF metrics(font());
    QRectF text = box.adjusted(pad + side + pad, 0, 0, 0);
    painter.setPen(m_status.inUse ? colour::bright : isEnabled() ? colour::text : colour::secondary);
    painter.drawText(text, Qt::AlignLeft | Qt::AlignVCenter, name());
    text.setLeft(text.left() + metrics.horizontalAdvance(name()) + theme::px(this, 6));
    painter.setPen(m_status.inUse && m_status.life != MasterLife::Alive ? colour::bright : colour::secondary);
    drawFigures(painter, text, Qt::AlignLeft | Qt::AlignVCenter, m_words);
}

void MasterChip::keyPressEvent(QKeyEvent* event)
{
    if (isEnter(*event))
        event->accept();
    else
        QAbstractButton::keyPressEvent(event);
}

void MasterChip::keyReleaseEvent(QKeyEvent* event)
{
    if (isEnter(*event))
        event->accept();
    else
        QAbstractButton::keyReleaseEvent(event);
}

MasterRow::MasterRow(QWidget* parent) : QWidget(parent), m_row(new QHBoxLayout(this))
{
    setAccessibleName(tr("Masters"));
    m_row->setContentsMargins(0, 0, 0, 0);
    m_row->setSpacing(4);
}

MasterChip* MasterRow::chip(std::size_t place)
{
    while (m_chips.size() <= place) {
        auto* added = new MasterChip(this);
        connect(added, &QAbstractButton::clicked, this, [this, added] { Q_EMIT masterChosen(added->status().kind); });
        m_row->addWidget(added);
        m_chips.push_back(added);
    }
    return m_chips[place];
}

void MasterRow::setMasters(const std::vector<MasterStatus>& masters, bool mayChange, Instant now)
{
    for (std::size_t place = 0; place < masters.size(); ++place) {
        auto* shown = chip(place);
        shown->setStatus(masters[place], lifeWords(masters[place], now));
        const bool may = mayChange && !masters[place].inUse && masters[place].life != MasterLife::Gone;
        if (!may)
            returnFocus(shown);
        shown->setEnabled(may);
        shown->show();
    }
    for (std::size_t place = masters.size(); place < m_chips.size(); ++place) {
        returnFocus(m_chips[place]);
        m_chips[place]->hide();
    }
}

} // namespace console
