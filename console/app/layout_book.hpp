// A user's named layouts, kept in a file.
#pragma once

#include "model/screen_plan.hpp"

#include <QStringList>

#include <vector>

namespace console {

/// GUI thread only. At most nine, one for each key. A file that is not understood stays until a layout is saved, and then a copy is kept.
class LayoutBook {
public:
    static constexpr std::size_t most = 9;
    static constexpr int longestName = 40;
    static constexpr qint64 mostBytes = 64 * 1024;

    /// Empty: they last for this run only.
    explicit LayoutBook(QString path);

    /// A sentence for each thing that was wrong.
    QStringList read();

    const std::vector<ScreenLayout>& layouts() const { return m_layouts; }

    /// Under its name, in place of one of the same name; a sentence when it could not be kept.
    QString save(ScreenLayout layout);
    QString remove(std::size_t place);

    /// Without what a line on a screen cannot show, and not too long.
    static QString cleaned(const QString& name);

private:
    QString write();

    const QString m_path;
    std::vector<ScreenLayout> m_layouts;
    bool m_damaged = false;
};

} // namespace console
