#include "simulation/sdf_reader.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <iostream>
#include <optional>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <sdf/Console.hh>
#include <sdf/Error.hh>
#include <sdf/ParserConfig.hh>

#include "common/error.hpp"
#include "common/read_bytes.hpp"
#include "simulation/sdf_preflight.hpp"

namespace swiftlet::simulation {
namespace {

using common::InputError;
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
  std::vector<std::string> lines() const { return linesOf(text_); }
  std::vector<std::string> errorLines() const { return linesOf(errors_); }

 private:
  static std::vector<std::string> linesOf(const std::ostringstream& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text.str());
    for (std::string line; std::getline(stream, line);) {
      const auto prefix_end = line.find("\033[0m ");
      if (prefix_end != std::string::npos) line.erase(0, prefix_end + 5);
      if (!line.empty()) lines.push_back(line);
    }
    return lines;
  }

  sdf::Console::ConsoleStream& stream_;
  std::ostream* before_;
  std::ostringstream errors_;
  std::streambuf* cerr_before_;
  std::ostringstream text_;
};

/// libsdformat 12 reads what included files include with its global configuration (gazebosim/sdformat#881).
class GlobalFindCallback {
 public:
  explicit GlobalFindCallback(std::function<std::string(const std::string&)> find)
      : before_(global().FindFileCallback()) {
    global().SetFindCallback(std::move(find));
  }
  ~GlobalFindCallback() { global().SetFindCallback(before_); }
  GlobalFindCallback(const GlobalFindCallback&) = delete;
  GlobalFindCallback& operator=(const GlobalFindCallback&) = delete;

 private:
  static sdf::ParserConfig& global() { return sdf::ParserConfig::GlobalConfig(); }
  std::function<std::string(const std::string&)> before_;
};

bool mentions(std::string text, std::string_view word) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  std::replace(text.begin(), text.end(), '_', ' ');
  return text.find(word) != std::string::npos;
}

bool isWarning(const sdf::Error& error) {
  switch (error.Code()) {
    case sdf::ErrorCode::ATTRIBUTE_INCORRECT_TYPE:  // "not defined in SDF": an unknown attribute.
    case sdf::ErrorCode::ELEMENT_INCORRECT_TYPE:    // An unknown element.
      return mentions(error.Message(), "not defined in sdf");
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

/// Where an error is. Those of the frame graphs have no line, but give their subject in brackets.
common::SourceLocation locate(const sdf::Error& error, const std::string& file, const std::string& text) {
  common::SourceLocation location{error.FilePath().value_or(file), error.LineNumber().value_or(0)};
  if (location.line > 0) return location;
  const std::string message = error.Message();
  for (auto open = message.find('['); open != std::string::npos; open = message.find('[', open + 1)) {
    const auto close = message.find(']', open);
    if (close == std::string::npos) break;
    std::string name = message.substr(open + 1, close - open - 1);
    if (const auto colon = name.rfind("::"); colon != std::string::npos) name.erase(0, colon + 2);
    const auto at = name.empty() ? std::string::npos : text.find(name);
    if (at == std::string::npos) continue;
    location.line =
        1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    return location;
  }
  return location;
}

struct Sorted {
  std::vector<Problem> problems;
  std::vector<std::string> warnings;
  bool wants_ground_plane = false;
};

Sorted sortErrors(const sdf::Errors& errors, const std::vector<std::string>& console, const std::string& file,
                  const std::string& text) {
  Sorted sorted;
  const sdf::Error* first_echo = nullptr;
  for (const sdf::Error& error : errors) {
    if (isEcho(error)) {
      if (first_echo == nullptr) first_echo = &error;
      continue;
    }
    Problem problem{locate(error, file, text), "", trimmed(error.Message()), ""};
    const bool lookup = error.Code() == sdf::ErrorCode::URI_LOOKUP;
    if (lookup && mentions(problem.message, "ground plane")) {
      sorted.wants_ground_plane = true;
      problem.message += "; a floor at z = 0 stands in for it";
    } else if (lookup && !mentions(problem.message, "/sun]")) {
      problem.hint = "give the folder that holds the model as a model path or in SDF_PATH";
      sorted.problems.push_back(problem);
      continue;
    } else if (!lookup && !isWarning(error)) {
      sorted.problems.push_back(problem);
      continue;
    }
    sorted.warnings.push_back(toString(problem));
  }
  // These are echoes: the original message was printed, with its line.
  if (sorted.problems.empty() && first_echo != nullptr && (sorted.warnings.empty() || !console.empty())) {
    std::string message = trimmed(first_echo->Message());
    for (const std::string& line : console) message += ": " + line;
    sorted.problems.push_back({locate(*first_echo, file, text), "", message, ""});
  }
  return sorted;
}

/// If an included file includes a model that is missing, libsdformat only prints it, as "Error Code 13:
/// [/sdf/model...:FILE:L12]: Msg: Unable to find uri[model://x]". If this were ignored, obstacles would be missing.
void addPrinted(const std::vector<std::string>& lines, Sorted& sorted) {
  static const std::regex kMissing(R"(:([^:\]]+):L([0-9]{1,7})\]: Msg: (Unable to find uri\[.*))");
  for (const std::string& line : lines) {
    std::smatch match;
    if (line.size() > 4096 || !std::regex_search(line, match, kMissing)) continue;
    const Problem problem{{match[1], std::stoi(match[2])},
                          "",
                          match[3],
                          "give the folder that holds the model as a model path or in SDF_PATH"};
    const bool floor = mentions(problem.message, "ground plane");
    sorted.wants_ground_plane = sorted.wants_ground_plane || floor;
    if (floor || mentions(problem.message, "/sun]"))
      sorted.warnings.push_back(toString(problem));
    else
      sorted.problems.push_back(problem);
  }
}

/// libsdformat also throws exceptions, of several kinds.
sdf::Errors loadOrExplain(sdf::Root& root, const std::string& file, const sdf::ParserConfig& config) {
  try {
    return root.Load(file, config);
  } catch (const std::exception& exception) {
    throw InputError(Problem{{file},
                             "",
                             fmt::format("libsdformat gave up: {}", exception.what()),
                             "leave out what was changed last, or halves of its models, to find the element"});
  }
}

}  // namespace

SdfFile readSdf(const std::string& file, const UriResolver& resolver) {
  const std::string text = common::readBytes(file);
  checkBeforeSdf(file, text, resolver);

  const auto find = [&resolver](const std::string& uri) { return resolver.findInclude(uri); };
  const GlobalFindCallback nested_includes(find);
  sdf::ParserConfig config;
  config.SetFindCallback(find);
  config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::ERR);

  SdfFile result;
  const ConsoleCapture console;
  const sdf::Errors errors = loadOrExplain(result.root, file, config);
  Sorted sorted = sortErrors(errors, console.lines(), file, text);
  addPrinted(console.errorLines(), sorted);
  if (sorted.problems.empty() && result.root.WorldCount() == 0 && result.root.Model() == nullptr)
    sorted.problems.push_back({{file}, "sdf", "it has neither a <world> nor a <model>", ""});
  if (!sorted.problems.empty()) throw InputError(sorted.problems);
  result.warnings = std::move(sorted.warnings);
  result.wants_ground_plane = sorted.wants_ground_plane;
  return result;
}

}  // namespace swiftlet::simulation
