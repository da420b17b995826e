// Messages about a wrong command line.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace swiftlet::apps {

/// What is wrong with the arguments that `program` has just refused, and where help is. A command or an option that
/// does not exist is reported first, with the one that was probably meant.
std::string usageProblem(const CLI::App& program, const CLI::ParseError& error);

}  // namespace swiftlet::apps
