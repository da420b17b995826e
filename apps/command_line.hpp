// The command line: commands with their arguments and options, each declared in one line, in the order of --help.
//
//   Command command = program.command("fly", "Fly a mission in the simulator.");
//   command.option("--seed", options->seed, {0, 1e9}, "Seed of all random numbers.");
//   command.runs([options] { return fly(*options); });
//
// CLI11 does the work, in command_line.cpp alone: it is all templates, and takes seconds to compile wherever it is
// read.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace swiftlet::apps {

/// Exit codes of the program.
enum ExitCode : int {
  kDone = 0,
  kFailed = 1,    ///< The command ran without the wanted result; docs/conventions.md says for each what that means.
  kBadInput = 2,  ///< Wrong usage or input that cannot be used, a mission that is not sound too.
};

/// What a chosen command does; returns the exit code of the program.
using Run = std::function<int()>;

/// Both ends belong to it; infinities and what is not a number never do.
struct Within {
  double low = 0.0, high = 0.0;
};

/// A handle: copies are the same command. The variables named must live until the command has run. Their
/// initial value is the default, which --help shows; the description gives that of an empty text or optional.
class Command {
 public:
  /// A command below this one.
  Command command(const std::string& name, const std::string& description);
  /// One of the commands below is to be chosen; `what` is missing otherwise, for instance "A metric".
  void requireCommand(const std::string& what);

  /// Arguments have no dashes and are required.
  void argument(const std::string& name, std::string& value, const std::string& description);
  void arguments(const std::string& name, std::vector<std::string>& values, const std::string& description);
  /// Arguments that may be left out.
  void optionalArguments(const std::string& name, std::vector<std::string>& values, const std::string& description);

  void option(const std::string& name, std::string& value, const std::string& description);
  /// May be given several times.
  void option(const std::string& name, std::vector<std::string>& values, const std::string& description);
  void option(const std::string& name, int& value, Within bounds, const std::string& description);
  void option(const std::string& name, std::optional<int>& value, Within bounds, const std::string& description);
  void option(const std::string& name, double& value, Within bounds, const std::string& description);
  void option(const std::string& name, std::optional<double>& value, Within bounds, const std::string& description);
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& choices,
              const std::string& description);
  /// One of the keys.
  template <typename Meaning>
  void choice(const std::string& name, std::string& value, const std::map<std::string, Meaning>& meanings,
              const std::string& description) {
    std::vector<std::string> choices;
    for (const auto& [key, meaning] : meanings) choices.push_back(key);
    choice(name, value, choices, description);
  }
  void flag(const std::string& name, bool& value, const std::string& description);
  /// --leaves, which flight::nodesWith reads.
  void leavesOption(std::vector<std::string>& files);

  /// The end of --help, for instance an example.
  void footer(const std::string& text);

  void runs(Run run);

 private:
  friend class Program;
  Command(CLI::App& app, Run& chosen) : app_(&app), chosen_(&chosen) {}
  template <typename Number>
  CLI::Option& number(const std::string& name, Number& value, Within bounds, const std::string& description);

  CLI::App* app_;
  Run* chosen_;
};

/// The program as the command above all others.
class Program {
 public:
  Program(const std::string& name, const std::string& version, const std::string& description);
  ~Program();

  Command& top() { return top_; }

  /// The chosen command, if any. Without one, help, the version or the mistake in the arguments has been printed, and
  /// the program ends with `exit_code`. A command or an option that does not exist is the first mistake to be printed,
  /// with the most similar one.
  struct Parsed {
    Run run;
    int exit_code = 0;
  };
  Parsed parse(int argc, const char* const* argv);

 private:
  std::unique_ptr<CLI::App> app_;
  Run chosen_;
  Command top_;
};

}  // namespace swiftlet::apps
