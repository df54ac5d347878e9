// A finger's way in a scroll area, from the mouse events that Qt makes of it: a drag scrolls, and a touch is a click.
#include "widgets/touch_scrolling.hpp"

#include "widgets/theme.hpp"

#include <QAbstractItemView>
#include <QApplication>
#include <QMouseEvent>
#include <QPointer>
#include <QScrollBar>
#include <QTouchEvent>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace console {

namespace {

constexpr double trembling = 16; ///< px at the reference that a finger moves while it touches: 4 mm

/// QScroller's gesture would leave the press with what is touched, click it where the finger ends on it, and keep double clicks from it.
class TouchScrolling : public QObject {
public:
    explicit TouchScrolling(QAbstractScrollArea& area) : QObject(area.viewport()), m_area(area)
    {
        area.viewport()->setAttribute(Qt::WA_AcceptTouchEvents);
        area.viewport()->installEventFilter(this);
    }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override
    {
        switch (event->type()) {
        case QEvent::TouchBegin: // accepted by nobody: Qt makes mouse events of it
            if (watched == m_area.viewport())
                begin(*static_cast<QTouchEvent*>(event));
            return false;
        case QEvent::Hide:
            forget();
            return false;
        case QEvent::MouseButtonPress:
        case QEvent::MouseButtonDblClick:
        case QEvent::MouseMove:
        case QEvent::MouseButtonRelease:
            return watched == m_touched && follow(*static_cast<QMouseEvent*>(event));
        default:
            return false;
        }
    }

private:
    bool isFollowed() const { return m_touched && (m_press != nullptr || m_drags); }

    void begin(const QTouchEvent& touch)
    {
        const QScrollBar& bar = *m_area.verticalScrollBar();
        if (isFollowed() || touch.points().isEmpty()) // a further finger
            return;
        forget();
        if (bar.maximum() <= bar.minimum())
            return;
        QWidget* viewport = m_area.viewport();
        QWidget* inside = viewport->childAt(viewport->mapFromGlobal(touch.points().first().globalPosition()).toPoint());
        m_touched = inside != nullptr ? inside : viewport;
        if (inside != nullptr)
            inside->installEventFilter(this);
    }

    bool follow(QMouseEvent& event)
    {
        if (event.type() == QEvent::MouseButtonRelease)
            return end(event);
        if (event.source() == Qt::MouseEventNotSynthesized)
            return false;
        if (event.type() == QEvent::MouseMove) {
            move(event.globalPosition().y());
            return true;
        }
        m_press.reset(event.clone());
        m_from = event.globalPosition().y();
        return true;
    }

    void move(double to)
    {
        if (m_press != nullptr && std::abs(to - m_from) >= std::max(QApplication::startDragDistance(), theme::px(&m_area, trembling))) {
            m_press.reset();
            m_drags = true;
            m_from = to;
            m_value = m_area.verticalScrollBar()->value();
        }
        if (m_drags)
            m_area.verticalScrollBar()->setValue(m_value - static_cast<int>(std::lround((to - m_from) / pixelsPerStep())));
    }

    /// Qt says by a release of no finger's that the touch does not count.
    bool end(const QMouseEvent& release)
    {
        const bool isClick = m_press != nullptr && release.source() != Qt::MouseEventNotSynthesized;
        const bool isOurs = isFollowed();
        QWidget* touched = m_touched;
        const auto press = std::move(m_press);
        forget();
        if (isClick)
            QCoreApplication::sendEvent(touched, press.get());
        return isOurs && !isClick;
    }

    void forget()
    {
        if (m_touched && m_touched != m_area.viewport())
            m_touched->removeEventFilter(this);
        m_touched.clear();
        m_press.reset();
        m_drags = false;
    }

    double pixelsPerStep() const
    {
        const auto* lines = qobject_cast<const QAbstractItemView*>(&m_area);
        const bool byLines = lines != nullptr && lines->verticalScrollMode() == QAbstractItemView::ScrollPerItem;
        return byLines ? std::max(1, lines->sizeHintForRow(0)) : 1;
    }

    QAbstractScrollArea& m_area;
    QPointer<QWidget> m_touched;     ///< hears nothing while a finger is on it
    std::unique_ptr<QEvent> m_press; ///< that it gets when the finger leaves it without a drag
    bool m_drags = false;
    double m_from = 0; ///< px on the screen
    int m_value = 0;   ///< of the bar, with the finger there
};

} // namespace

void scrollByTouch(QAbstractScrollArea& area) { new TouchScrolling(area); }

} // namespace console
