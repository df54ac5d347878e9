// The likely cause of a loss, and what to try first: by what a probe found and what else was lost (console design, the table of causes).
#include "model/incident_model.hpp"

#include <QCoreApplication>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::Prompt)
};

ProbeAdvice unreachable(std::optional<bool> othersAnswer)
{
    if (othersAnswer == true)
        return {Text::tr("The device's computer does not answer; others there do"), Text::tr("Power and network cable of that device")};
    if (othersAnswer == false)
        return {Text::tr("The device's computer does not answer; others there do not either"), Text::tr("The site's network line")};
    return {Text::tr("The device's computer does not answer"), Text::tr("Power and network cable of that device, or the site's line")};
}

/// What the library said of the identity, in a few words; empty when it said another thing.
QString identityTrouble(const QString& detail)
{
    const struct {
        const char* said;
        QString words;
    } table[] = {
        {" is device ", Text::tr("it is another device")},
        {"expired", Text::tr("a certificate has expired")},
        {"not valid yet", Text::tr("a certificate is not valid yet")},
        {"revoked", Text::tr("a certificate was revoked")},
        {"authority", Text::tr("of an authority that is not known there")},
    };
    for (const auto& row : table)
        if (detail.contains(QLatin1String(row.said)))
            return row.words;
    return {};
}

ProbeAdvice byIdentity(const QString& detail)
{
    const auto trouble = identityTrouble(detail);
    const auto first = Text::tr("Do not bypass this: call service");
    if (trouble.isEmpty())
        return {Text::tr("The device answered but its identity was refused"), first};
    return {Text::tr("The device answered but its identity was refused: %1").arg(trouble), first};
}

ProbeAdvice byInterface(const QString& ownHost)
{
    const auto first = Text::tr("Plug, cable and switch at this side");
    if (ownHost.isEmpty())
        return {Text::tr("This console has no network on that port"), first};
    return {Text::tr("This console has no network on its port with the address %1").arg(ownHost), first};
}

ProbeAdvice byProbe(const LinkDiagnosis& diagnosis, std::optional<bool> othersAnswer, const QString& ownHost)
{
    switch (diagnosis.probe) {
    case ProbeFinding::NotProbed:
        return {Text::tr("Not known yet: run the checks"), Text::tr("Run checks")};
    case ProbeFinding::InterfaceDown:
        return byInterface(ownHost);
    case ProbeFinding::NoRoute:
        return {Text::tr("Network up, no way to the hospital"), Text::tr("Gateway and VPN")};
    case ProbeFinding::HostUnreachable:
        return unreachable(othersAnswer);
    case ProbeFinding::ConnectionRefused:
        return {Text::tr("The computer answers, its program is not running"), Text::tr("Restart the program at the patient side")};
    case ProbeFinding::TlsFailure:
        return byIdentity(diagnosis.probeDetail);
    case ProbeFinding::PeerSilent:
        return {Text::tr("The device's program hangs or is overloaded"), Text::tr("Wait 2 s, run the checks, then restart its program")};
    case ProbeFinding::Reachable:
        return {Text::tr("The device answers again"), Text::tr("Re-open the channel")};
    }
    return {};
}

bool saysLittle(ProbeFinding probe)
{
    return probe == ProbeFinding::NotProbed || probe == ProbeFinding::PeerSilent || probe == ProbeFinding::Reachable;
}

/// That a device's computer is not reached says little of that computer where no other is reached either.
bool saysLittleOfOne(ProbeFinding probe)
{
    return saysLittle(probe) || probe == ProbeFinding::HostUnreachable || probe == ProbeFinding::NoRoute;
}

} // namespace

ProbeAdvice adviceFor(const LinkDiagnosis& diagnosis, const PromptSurroundings& around, bool onlyPictures, std::optional<bool> othersAnswer)
{
    const bool allLost = around.ownLinks > 1 && around.lostLinks == around.ownLinks && around.lostTogether;
    if (allLost && saysLittleOfOne(diagnosis.probe))
        return {Text::tr("All links were lost at once: this console's side or the line, not a device"),
                Text::tr("Network port and VPN of this console")};
    if (onlyPictures && saysLittle(diagnosis.probe))
        return {Text::tr("Only the pictures are lost: their way, or the X-ray sender"),
                Text::tr("Re-open the picture link alone; motion stays inhibited")};
    return byProbe(diagnosis, othersAnswer, around.ownHost);
}

} // namespace console
