// What the start page and "About" say of the program and of the system it is part of.
#pragma once

#include "model/console_models.hpp"
#include "widgets/fact_list.hpp"

namespace console {

/// What only the composition root knows.
struct ProgramFacts {
    QString version;      ///< empty: not known
    QString operatorName; ///< empty: nobody is named
    QString help;         ///< where more can be read; empty: on the command line only
};

/// The sentence that stands wherever somebody asks what this is.
QString researchNotice();

/// Version, system, operator, masters, sound, help: what is so now. What is not known is said to be so.
std::vector<Fact> presentFacts(const ConsoleModels& models, const ProgramFacts& program);

/// The parts that the console is built with, and the names of their licences as Debian's copyright files give them.
std::vector<Fact> licenceFacts();

} // namespace console
