// The facts, from the models and from what the composition root says.
#include "widgets/program_facts.hpp"

#include <QCoreApplication>

#include <algorithm>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::ProgramFacts)
};

constexpr int shownHash = 16; ///< hex digits; what two sites compare aloud is the first six

Fact systemFact(const SessionModel& sessions)
{
    const QString title = sessions.topologyTitle().isEmpty() ? sessions.topologyName() : sessions.topologyTitle();
    if (title.isEmpty())
        return {Text::tr("System"), Text::tr("no topology is loaded"), false};
    const QString version = sessions.topologyVersion().isEmpty() ? QString() : Text::tr(", version %1").arg(sessions.topologyVersion());
    return {Text::tr("System"), Text::tr("%1%2, %3 devices, %4 links of this console")
                                    .arg(title, version)
                                    .arg(sessions.devices().size())
                                    .arg(sessions.ownLinkCount())};
}

Fact hashFact(const SessionModel& sessions)
{
    const QString hash = sessions.topologyHash();
    if (hash.isEmpty())
        return {Text::tr("Topology hash"), Text::tr("not known"), false};
    const QString secured = sessions.secured() ? Text::tr("sessions are encrypted") : Text::tr("SESSIONS ARE NOT ENCRYPTED");
    return {Text::tr("Topology hash"), Text::tr("%1 %2 \u00B7 %3").arg(hash.left(6), hash.mid(6, shownHash - 6), secured)};
}

Fact masterFact(const HandState& hand)
{
    QStringList words;
    for (const MasterStatus& master : hand.masters())
        words << (master.inUse ? Text::tr("%1 (in use): %2") : Text::tr("%1: %2")).arg(master.name, word(master.life));
    return {Text::tr("Masters"), words.isEmpty() ? Text::tr("not known yet") : words.join(QStringLiteral(" \u00B7 ")), !words.isEmpty()};
}

Fact soundFact(const ConsoleModels& models)
{
    if (models.alarms.stands(AlarmCondition::SoundFailed))
        return {Text::tr("Alarm sound"), Text::tr("DOES NOT WORK: see the alarm band")};
    if (models.selfTest.step() == AlarmSelfTest::Step::Failed)
        return {Text::tr("Alarm sound"), Text::tr("the last self-test was not confirmed")};
    if (models.selfTest.passedInAll() > 0)
        return {Text::tr("Alarm sound"), Text::tr("seen and heard in this run; F8 tests again before each arming")};
    return {Text::tr("Alarm sound"), Text::tr("not known: nobody has tested it in this run (F8)"), false};
}

} // namespace

QString researchNotice() { return Text::tr("Research software. Not a medical device: it has no approval for use on patients anywhere."); }

std::vector<Fact> presentFacts(const ConsoleModels& models, const ProgramFacts& program)
{
    const bool versioned = !program.version.isEmpty();
    const bool named = !program.operatorName.isEmpty();
    const QString help = Text::tr("liena-console --help");
    return {{Text::tr("Version"), versioned ? program.version : Text::tr("not known"), versioned},
            systemFact(models.sessions),
            hashFact(models.sessions),
            {Text::tr("Operator"), named ? program.operatorName : Text::tr("nobody is named (--operator NAME)"), named},
            masterFact(models.hand),
            soundFact(models),
            {Text::tr("Help"), program.help.isEmpty() ? help : program.help + QStringLiteral(" \u00B7 ") + help}};
}

std::vector<Fact> licenceFacts()
{
    const auto part = [](const char* name, const char* licence) { return Fact{QString::fromLatin1(name), QString::fromLatin1(licence)}; };
    return {part("LiENa", "BSD-3-Clause"),
            part("Qt 6", "LGPL-3 or GPL-2"),
            part("VTK 9.1", "BSD-3-clause"),
            part("OpenCV 4.6", "Apache-2.0 and BSD-3-Clause"),
            part("OpenSSL 3", "Apache-2.0"),
            part("Boost 1.74", "BSL-1.0"),
            part("pugixml", "Expat"),
            part("SDL 2", "zlib/libpng"),
            part("libspnav", "BSD-3-clause"),
            part("DCMTK", "OFFIS, Apache-2.0 and BSD-3-clause"),
            part("libjpeg-turbo", "BSD-BY-LC-NE, BSD-3-clause and Zlib"),
            part("fmt", "Expat with embedded exception"),
            part("Inter", "OFL-1.1 (here changed, as LiENa Sans)"),
            part("WenQuanYi Micro Hei", "Apache-2.0 or GPL-3+ with Font exception (here changed, as LiENa Hei)")};
}

} // namespace console
