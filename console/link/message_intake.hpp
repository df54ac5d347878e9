// Puts each received message into the model that it belongs to.
#pragma once

#include "model/console_models.hpp"

#include <liena/message.hpp>

#include <QSet>
#include <QString>

namespace console {

/// GUI thread only.
class MessageIntake {
public:
    explicit MessageIntake(ConsoleModels& models) : m_models(models) {}

    /// True when the console knows that message and its fields, and `origin` is the one device whose reports of it are shown: the first of
    /// its kind that is linked to this console. Two robots in one model would be a robot that is not there.
    bool take(quint32 origin, const liena::Message& message);

private:
    void complain(const QString& complaint);

    ConsoleModels& m_models;
    QSet<QString> m_complained; ///< one line per cause
};

} // namespace console
