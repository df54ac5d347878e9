// One way of writing a file: whole, or not at all.
#pragma once

#include <QByteArray>
#include <QString>

namespace console {

/// Empty, or one sentence with the file, the reason and what to do; what stood there before then still stands.
QString writeWhole(const QByteArray& bytes, const QString& path);

} // namespace console
