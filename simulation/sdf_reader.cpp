#include "simulation/sdf_reader.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <sstream>

#include <sdf/Console.hh>
#include <sdf/Error.hh>
#include <sdf/ParserConfig.hh>

#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "common/misleading.hpp"
#include "common/read_bytes.hpp"
#include "simulation/sdf_encoding.hpp"
#include "simulation/sdf_sources.hpp"
#include "simulation/sdf_spelling.hpp"

namespace swiftlet::simulation {
namespace {

using common::InputError;
using common::Message;
using common::Problem;

/// Captures what libsdformat prints during its lifetime. If a file fails as SDF, libsdformat also tries URDF, whose
/// parser complains on std::cerr, like errors of included files.
class ConsoleCapture {
 public:
  ConsoleCapture()
      : stream_(sdf::Console::Instance()->GetMsgStream()),
        before_(stream_.GetStream()),
        cerr_before_(std::cerr.rdbuf(errors_.rdbuf())) {
    stream_.SetStream(&text_);
  }
  ~ConsoleCapture() {
    stream_.SetStream(before_);
    std::cerr.rdbuf(cerr_before_);
  }
  ConsoleCapture(const ConsoleCapture&) = delete;
  ConsoleCapture& operator=(const ConsoleCapture&) = delete;

  /// Its lines without colours and without the position in libsdformat's own source.
  std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    std::istringstream stream(text_.str());
    for (std::string line; std::getline(stream, line);) {
      const auto prefix_end = line.find("\033[0m ");
      if (prefix_end != std::string::npos) line.erase(0, prefix_end + 5);
      if (!line.empty()) lines.push_back(line);
    }
    return lines;
  }

 private:
  sdf::Console::ConsoleStream& stream_;
  std::ostream* before_;
  std::ostringstream errors_;
  std::streambuf* cerr_before_;
  std::ostringstream text_;
};

bool mentions(std::string_view message, std::string_view word) {
  std::string text = common::lowerCase(message);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text.find(word) != std::string::npos;
}

/// An element or attribute that SDF does not have.
bool isUnknown(const sdf::Error& error) {
  const bool of_kind = error.Code() == sdf::ErrorCode::ATTRIBUTE_INCORRECT_TYPE ||
                       error.Code() == sdf::ErrorCode::ELEMENT_INCORRECT_TYPE;
  return of_kind && mentions(error.Message(), "not defined in sdf");
}

bool isWarning(const sdf::Error& error) {
  if (isUnknown(error)) return true;
  switch (error.Code()) {
    case sdf::ErrorCode::ATTRIBUTE_DEPRECATED:
    case sdf::ErrorCode::ELEMENT_DEPRECATED:
    case sdf::ErrorCode::VERSION_DEPRECATED:
    case sdf::ErrorCode::LINK_INERTIA_INVALID:
    case sdf::ErrorCode::MODEL_WITHOUT_LINK:
    case sdf::ErrorCode::MODEL_CANONICAL_LINK_INVALID:
    case sdf::ErrorCode::JOINT_CHILD_LINK_INVALID:
    case sdf::ErrorCode::JOINT_PARENT_LINK_INVALID:
    case sdf::ErrorCode::JOINT_PARENT_SAME_AS_CHILD:
      return true;
    default:
      return false;
  }
}

/// Codes that only repeat that something inside failed.
bool isEcho(const sdf::Error& error) {
  const std::string message = error.Message();
  return error.Code() == sdf::ErrorCode::FILE_READ || message.starts_with("Failed to load a world") ||
         message.starts_with("Error reading element");
}

std::string trimmed(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
  return text;
}

/// The names in brackets in a message, in their order.
std::vector<std::string> namesIn(const std::string& message) {
  std::vector<std::string> names;
  for (auto open = message.find('['); open != std::string::npos; open = message.find('[', open + 1)) {
    const auto close = message.find(']', open);
    if (close == std::string::npos) break;
    names.push_back(message.substr(open + 1, close - open - 1));
  }
  return names;
}

/// Where an error is. Those of the frame graphs have no line, but name their subject.
common::SourceLocation locate(const sdf::Error& error, const std::string& file, const std::string& text) {
  common::SourceLocation location{error.FilePath().value_or(file), error.LineNumber().value_or(0)};
  if (location.line > 0) return location;
  for (std::string name : namesIn(error.Message())) {
    if (const auto colon = name.rfind("::"); colon != std::string::npos) name.erase(0, colon + 2);
    const auto at = name.empty() ? std::string::npos : text.find(name);
    if (at == std::string::npos) continue;
    location.line = locationIn(file, text, at).line;
    return location;
  }
  return location;
}

struct Sorted {
  std::vector<Problem> problems;
  std::vector<Problem> missing;
  std::vector<Problem> warnings;
};

/// Of an unknown element or attribute without which something would be missing or stand elsewhere.
std::optional<Problem> misspelling(const sdf::Error& error, const common::SourceLocation& location) {
  const std::vector<std::string> names = namesIn(error.Message());  // Its own and that of the element around it.
  if (!isUnknown(error) || names.size() < 2) return std::nullopt;
  const std::string hint = spellingHint(names[0], names[1]);
  if (hint.empty()) return std::nullopt;
  return Problem{location, names[1], Message("sdf.no-such-part", "SDF has no `{}` in it", names[0]), hint};
}

/// As libsdformat says it.
Problem reported(const sdf::Error& error, const std::string& file, const std::string& text) {
  return {locate(error, file, text), "", Message("sdf.error", "{}", trimmed(error.Message())), ""};
}

Sorted sortErrors(const sdf::Errors& errors, const std::vector<std::string>& console, const std::string& file,
                  const std::string& text) {
  Sorted sorted;
  const sdf::Error* first_echo = nullptr;
  for (const sdf::Error& error : errors) {
    Problem problem = reported(error, file, text);
    problem.hint = common::misleadingHint(error.Message());
    if (isEcho(error))
      first_echo = first_echo == nullptr ? &error : first_echo;
    else if (auto misspelt = misspelling(error, problem.location))
      sorted.missing.push_back(*std::move(misspelt));
    else if (isWarning(error))
      sorted.warnings.push_back(std::move(problem));
    else
      sorted.problems.push_back(std::move(problem));
  }
  // These are echoes: the original message was printed, with its line.
  const bool explained = !sorted.missing.empty() || (!sorted.warnings.empty() && console.empty());
  if (sorted.problems.empty() && first_echo != nullptr && !explained) {
    Problem problem = reported(*first_echo, file, text);
    for (const std::string& line : console) problem.message += ": " + line;
    constexpr std::string_view kLine = "Line number=";  // Of TinyXML-2.
    const std::string& said = problem.message.text();
    if (const auto at = said.find(kLine); at != std::string::npos && problem.location.line == 0)
      problem.location.line = std::atoi(said.c_str() + at + kLine.size());
    sorted.problems.push_back(std::move(problem));
  }
  return sorted;
}

/// libsdformat also throws exceptions, of several kinds.
sdf::Errors loadOrExplain(sdf::Root& root, const SdfSources& sources, const sdf::ParserConfig& config) {
  try {
    return root.Load(sources.toRead(), config);
  } catch (const std::exception& exception) {
    throw InputError({sources.originalOf(sources.toRead())}, "",
                     Message("sdf.gave-up", "libsdformat gave up: {}", exception.what()),
                     "leave out what was changed last, or halves of its models, to find the element");
  }
}

/// Messages and the search for meshes go by the files that the user has.
void nameOriginals(sdf::Element& element, const SdfSources& sources) {
  element.SetFilePath(sources.originalOf(element.FilePath()));
  for (sdf::ElementPtr child = element.GetFirstElement(); child; child = child->GetNextElement())
    nameOriginals(*child, sources);
}

}  // namespace

SdfFile readSdf(const std::string& file, const UriResolver& resolver) {
  const SdfSources sources(file, resolver);
  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::ERR);

  SdfFile result{{}, sources.missing(), sources.warnings(), sources.wantsGroundPlane()};
  const ConsoleCapture console;
  const sdf::Errors errors = loadOrExplain(result.root, sources, config);
  Sorted sorted = sortErrors(errors, console.lines(), sources.toRead(),
                             utf8Text(sources.toRead(), common::readText(sources.toRead())));
  if (sorted.problems.empty() && result.root.WorldCount() == 0 && result.root.Model() == nullptr)
    sorted.problems.push_back({{file}, "sdf", Message("sdf.no-world", "it has neither a <world> nor a <model>"), ""});
  for (std::vector<Problem>* problems : {&sorted.problems, &sorted.missing, &sorted.warnings})
    for (Problem& problem : *problems) {
      problem.location.file = sources.originalOf(problem.location.file);
      problem.message = Message(problem.message.name(), "{}", sources.withOriginals(problem.message.text()));
    }
  result.missing.insert(result.missing.end(), sorted.missing.begin(), sorted.missing.end());
  if (!sorted.problems.empty()) {
    sorted.problems.insert(sorted.problems.begin(), result.missing.begin(), result.missing.end());
    throw InputError(sorted.problems);
  }
  result.warnings.insert(result.warnings.end(), sorted.warnings.begin(), sorted.warnings.end());
  if (result.root.Element()) nameOriginals(*result.root.Element(), sources);
  return result;
}

}  // namespace swiftlet::simulation
