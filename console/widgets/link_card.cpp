// A card is painted as one picture; only its button is a widget.
#include "widgets/link_card.hpp"

#include "widgets/double_click.hpp"
#include "widgets/figures.hpp"
#include "widgets/focus_return.hpp"
#include "widgets/icons.hpp"
#include "widgets/link_arrow.hpp"
#include "widgets/sparkline.hpp"
#include "widgets/theme.hpp"
#include "widgets/touch_button.hpp"

#include <QPainter>
#include <QPainterPath>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

// Rows of the card from top to bottom, in pixels.
struct LinkCard::Metrics {
    double pad, caption, strong, icon;
    QRectF head, directions, figures, spark;
};

LinkCard::LinkCard(quint32 peer, QWidget* parent) : QFrame(parent), m_peer(peer), m_action(new TouchButton(this))
{
    theme::setTextRole(this, TextRole::Body);
    theme::setTextRole(m_action, TextRole::Strong);
    m_action->setAutoDefault(false);
    m_action->setFocusPolicy(Qt::TabFocus); // a click leaves the keys with the hand
    m_action->setProperty("compact", true);
    connect(m_action, &QPushButton::clicked, this, &LinkCard::act);
}

LinkCard::Metrics LinkCard::metricsNow() const
{
    const double scale = theme::scaleOf(this);
    Metrics m{};
    m.pad = theme::px(this, 12);
    m.caption = QFontMetricsF(theme::font(TextRole::Caption, scale)).height();
    m.strong = QFontMetricsF(theme::font(TextRole::Strong, scale)).height();
    m.icon = m.strong * 2;
    const double left = m.pad * 1.3;
    const double width = this->width() - left - m.pad;
    double y = m.pad * 0.8;
    m.head = {left, y, width, m.icon};
    y += m.icon + m.pad * 0.4;
    m.directions = {left, y, width, m.caption * 1.15};
    y += m.directions.height() + m.pad * 0.4;
    m.figures = {left, y, width, 2 * (m.caption + m.strong) + m.pad * 0.3};
    y += m.figures.height() + m.pad * 0.4;
    m.spark = {left, y, width, m.strong * 1.3};
    return m;
}

QSize LinkCard::sizeHint() const
{
    const Metrics m = metricsNow();
    return {theme::px(this, 200), int(m.spark.bottom() + m.pad * 1.6 + m_action->sizeHint().height())};
}

void LinkCard::resizeEvent(QResizeEvent*)
{
    const Metrics m = metricsNow();
    const int tall = m_action->sizeHint().height();
    m_action->setGeometry(int(m.head.left()), int(height() - tall - m.pad * 0.8), int(m.head.width()), tall);
}

void LinkCard::setLink(const LinkNode& link, const DeviceNode& device, Instant now)
{
    m_link = link;
    m_device = device;
    m_now = now;
    setAccessibleName(tr("Link to %1").arg(device.title));
    setAccessibleDescription(word(link.state));
    setToolTip((link.failure.isEmpty() ? device.address : link.failure).toHtmlEscaped());
    updateButton();
    update();
}

void LinkCard::updateButton()
{
    QString text = word(m_link.state);
    if (mayOpen(m_link.state))
        text = tr("Open");
    else if (mayClose(m_link.state))
        text = tr("Close");
    else if (mayReopen(m_link.state))
        text = tr("Re-open");
    const bool may = mayOpen(m_link.state) || mayClose(m_link.state) || mayReopen(m_link.state);
    if (text != m_action->text()) {
        m_action->setText(text);
        m_action->setAccessibleName(may ? tr("%1 the link to %2").arg(text, m_device.title) : text);
    }
    if (!may)
        returnFocus(m_action);
    m_action->setEnabled(may);
}

void LinkCard::act()
{
    if (isDoubleClick(m_acted))
        return; // the button may offer the opposite by now
    if (mayOpen(m_link.state))
        Q_EMIT openRequested(m_peer);
    else if (mayClose(m_link.state))
        Q_EMIT closeRequested(m_peer);
    else if (mayReopen(m_link.state))
        Q_EMIT reopenRequested(m_peer);
}

void LinkCard::paintHead(QPainter& painter, const Metrics& m) const
{
    const double scale = theme::scaleOf(this);
    icons::draw(painter, QRectF(m.head.left(), m.head.top(), m.icon, m.icon), icons::forKind(m_device.kind), colour::text);
    painter.setFont(theme::font(TextRole::Strong, scale));
    const QRectF name = m.head.adjusted(m.icon + m.pad * 0.6, 0, 0, -m.strong);
    painter.setPen(isTrouble(m_link.state) ? colour::bright : colour::secondary);
    painter.drawText(name.translated(0, m.strong), Qt::AlignLeft | Qt::AlignVCenter, word(m_link.state));
    painter.setPen(colour::bright);
    painter.drawText(name, Qt::AlignLeft | Qt::AlignVCenter,
                     QFontMetricsF(painter.font()).elidedText(m_device.title, Qt::ElideRight, name.width()));
}

void LinkCard::paintDirections(QPainter& painter, const Metrics& m) const
{
    painter.setFont(theme::font(TextRole::Caption, theme::scaleOf(this)));
    const double half = m.directions.width() / 2 - m.pad / 2;
    const QRectF out(m.directions.left(), m.directions.top(), half, m.directions.height());
    const QRectF in(m.directions.right() - half, m.directions.top(), half, m.directions.height());
    const double words =
        std::max(QFontMetricsF(painter.font()).horizontalAdvance(tr("out")), QFontMetricsF(painter.font()).horizontalAdvance(tr("in"))) +
        m.pad * 0.5;
    painter.setPen(colour::secondary);
    painter.drawText(out, Qt::AlignLeft | Qt::AlignVCenter, tr("out"));
    painter.drawText(in, Qt::AlignLeft | Qt::AlignVCenter, tr("in"));
    const ArrowLook sent = arrowLook(m_link.state, m_link.toPeerStands());
    const ArrowLook heard = arrowLook(m_link.state, m_link.fromPeerStands());
    drawLinkArrow(painter, QLineF(out.left() + words, out.center().y(), out.right(), out.center().y()), sent);
    drawLinkArrow(painter, QLineF(in.right(), in.center().y(), in.left() + words, in.center().y()), heard);
}

void LinkCard::paintFigures(QPainter& painter, const Metrics& m) const
{
    const bool open = carriesMessages(m_link.state);
    const LinkFigures& f = m_link.figures;
    const auto ms = [open](std::optional<Duration> d) {
        return open && d ? figure(milliseconds(*d), 1, tr("ms")) : figure({}, 1, tr("ms"));
    };
    const auto heard = m_link.heardAgo(m_now);
    const struct {
        QString caption, value;
    } cells[4] = {{tr("Heard ago"), heard && m_link.state != LinkState::Closed ? spokenAge(*heard) : tr("\u2014")},
                  {tr("Round trip"), ms(f.roundTrip)},
                  {tr("Jitter"), ms(f.jitter)},
                  {tr("Loss so far"), open ? figure(f.loss() * 100, 1, tr("%")) : figure({}, 1, tr("%"))}};
    const double scale = theme::scaleOf(this);
    const double columnWidth = m.figures.width() / 2;
    const double rowHeight = m.caption + m.strong + m.pad * 0.3;
    for (int i = 0; i < 4; ++i) {
        const double x = m.figures.left() + (i % 2) * columnWidth;
        const double y = m.figures.top() + (i / 2) * rowHeight;
        painter.setFont(theme::font(TextRole::Caption, scale));
        painter.setPen(colour::secondary);
        painter.drawText(QRectF(x, y, columnWidth, m.caption), Qt::AlignLeft | Qt::AlignVCenter, cells[i].caption);
        painter.setFont(theme::font(TextRole::Strong, scale));
        painter.setPen(open ? colour::text : colour::secondary);
        drawFigures(painter, QRectF(x, y + m.caption, columnWidth, m.strong), Qt::AlignLeft | Qt::AlignVCenter, cells[i].value);
    }
}

void LinkCard::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const bool lost = m_link.state == LinkState::StandBy || m_link.state == LinkState::Reconnecting;
    const QRectF body = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
    QPainterPath path;
    path.addRoundedRect(body, 5, 5);
    painter.fillPath(path, colour::panel);
    painter.setPen(QPen(isTrouble(m_link.state) ? colour::bright : colour::line, isTrouble(m_link.state) ? 1.6 : 1));
    painter.drawPath(path);
    if (lost)
        painter.fillRect(QRectF(0, 6, theme::px(this, 7), height() - 12), colour::high);
    const Metrics m = metricsNow();
    paintHead(painter, m);
    paintDirections(painter, m);
    paintFigures(painter, m);
    drawSparkline(painter, m.spark, m_link.history, m_now);
}

} // namespace console
