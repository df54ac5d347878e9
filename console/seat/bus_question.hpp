// A question over D-Bus for whose answer nobody waits.
#pragma once

#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusPendingCallWatcher>
#include <QObject>

#include <functional>

namespace console {

inline constexpr int busPatience = 5000; ///< milliseconds; after them the answer is an error

/// `hear` is called once with the answer, or with an error, on the thread of `asker`, unless that is gone by then. Nobody is started to
/// answer it.
inline void askOver(const QDBusConnection& bus, QDBusMessage question, QObject* asker,
                    const std::function<void(const QDBusPendingCall&)>& hear)
{
    question.setAutoStartService(false);
    auto* call = new QDBusPendingCallWatcher(bus.asyncCall(question, busPatience), asker);
    QObject::connect(call, &QDBusPendingCallWatcher::finished, asker, [hear](QDBusPendingCallWatcher* answered) {
        answered->deleteLater();
        hear(*answered);
    });
}

} // namespace console
