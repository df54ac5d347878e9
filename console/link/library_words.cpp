// The library's texts as they stand there, for the catalogues to translate.
#include "link/library_words.hpp"

#include "link/translate.hpp"

#include <QCoreApplication>

#include <array>

namespace console {

namespace {

[[maybe_unused]] constexpr std::array reasons{
    QT_TRANSLATE_NOOP("console::LibraryWords", "The attempt ended without a word from the other side."),
    QT_TRANSLATE_NOOP("console::LibraryWords",
                      "The other device does not find this one in its topology: give both the same topology file."),
    QT_TRANSLATE_NOOP("console::LibraryWords",
                      "The topology has no link between the two devices: add it and give every device the same file."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "The two devices hold different topology files: give both the same bytes and restart them."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "The two devices speak different versions of the protocol: update the older one."),
    QT_TRANSLATE_NOOP("console::LibraryWords",
                      "A message set does not hold what its device type needs: check the file with `liena check`."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "The link is in stand-by: a person has to re-open it."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "An opening or closing with this device is in hand: wait a moment and try again."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "One side broke the protocol: note the versions of both programs and report it."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "The dialogue did not end in time: the other program is overloaded or stuck."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "The other program is stopping: start it again."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "The device is in a session already: look for a second program with the same identity."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "The device shows another message set than the one accepted for its type: a person has to "
                                               "read the changes and accept it (liena sets accept)."),
    QT_TRANSLATE_NOOP("console::LibraryWords",
                      "One of the two devices begins no session until that is mended: see the detail, or its log.")};

[[maybe_unused]] constexpr std::array probes{
    QT_TRANSLATE_NOOP("console::LibraryWords", "No probe was made yet."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "This computer has no network there: plug, cable and switch at this side."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "The network is up and knows no way to the device: gateway and VPN."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "The device's computer does not answer: its power and cable, or the site's line."),
    QT_TRANSLATE_NOOP("console::LibraryWords",
                      "The computer answers and its program is not running: start the program at the patient side."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "The device answered and an identity was refused: do not bypass this, call service."),
    QT_TRANSLATE_NOOP("console::LibraryWords",
                      "The device accepts connections and says nothing: its program hangs or is overloaded; wait 2 s, then restart it."),
    QT_TRANSLATE_NOOP("console::LibraryWords", "The device answers again: the channel can be re-opened.")};

[[maybe_unused]] constexpr std::array kinds{QT_TRANSLATE_NOOP("console::LibraryWords", "invalid argument"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "file unreadable"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "file unwritable"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "XML invalid"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "message set invalid"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "topology invalid"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "certificate invalid"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "address unavailable"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "network failure"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "unknown device"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "unknown message"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "no link"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "not open"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "not yet"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "stand-by"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "no incident"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "busy"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "forbidden"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "value refused"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "queue full"),
                                            QT_TRANSLATE_NOOP("console::LibraryWords", "stopped")};

QString translated(std::string_view words) { return QCoreApplication::translate("console::LibraryWords", std::string(words).c_str()); }

} // namespace

QString words(liena::RejectReason reason) { return translated(liena::explain(reason)); }

QString words(liena::ProbeResult probe) { return translated(liena::explain(probe)); }

QString words(const liena::Error& error)
{
    const auto kind = liena::toString(error.code);
    const auto inLanguage = translated(kind);
    const auto what = text(error.what);
    return inLanguage == text(kind) ? what : QCoreApplication::translate("console::LibraryWords", "%1 (%2)").arg(inLanguage, what);
}

} // namespace console
