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

    /// True when the console knows that message and its fields.
    bool take(const liena::Message& message);

private:
    bool dispatch(const liena::Message& message);
    void complain(const QString& complaint);

    ConsoleModels& m_models;
    QSet<QString> m_complained; ///< one line per cause
};

} // namespace console
