// What is told when the command line is wrong.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace swiftlet::apps {

/// What was wrong with the arguments that `program` has just refused, and where help is. A command or an option that
/// does not exist is told before anything else, with the one that was probably meant.
std::string usageProblem(const CLI::App& program, const CLI::ParseError& error);

}  // namespace swiftlet::apps
