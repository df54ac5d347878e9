// What all masters share.
#include "input/master_device.hpp"

namespace console {

void MasterDevice::setListening(bool listening)
{
    if (m_listening == listening)
        return;
    m_listening = listening;
    listeningChanged();
}

} // namespace console
