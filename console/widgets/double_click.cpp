// The desktop says how long a double click may take.
#include "widgets/double_click.hpp"

#include <QApplication>
#include <QElapsedTimer>

namespace console {

bool isDoubleClick(QElapsedTimer& since)
{
    if (since.isValid() && since.elapsed() < QApplication::doubleClickInterval())
        return true;
    since.start();
    return false;
}

} // namespace console
