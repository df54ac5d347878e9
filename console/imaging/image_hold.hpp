// Keeps the last picture of a run when the run is over.
#pragma once

#include "imaging/display_picture.hpp"

#include <QObject>

#include <optional>

namespace console {

/// GUI thread only.
class ImageHold : public QObject {
    Q_OBJECT
public:
    explicit ImageHold(QObject* parent = nullptr);

    /// Each live picture; the first of another run ends the one before it.
    void take(const DisplayPicture& picture);

    /// The pedal is up: the picture that stands there is the run's last.
    void endRun();

Q_SIGNALS:
    /// A copy with the role of a hold.
    void held(const console::DisplayPicture& picture);

private:
    void tell();

    std::optional<DisplayPicture> m_last;
    std::optional<quint64> m_heldNs; ///< its run has ended with the picture that was taken then
};

} // namespace console
