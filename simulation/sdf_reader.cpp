#include "simulation/sdf_reader.hpp"

#include <expat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <sstream>

#include <fmt/format.h>
#include <sdf/Console.hh>
#include <sdf/Error.hh>
#include <sdf/ParserConfig.hh>

#include "common/error.hpp"

namespace swiftlet::simulation {
namespace {

using common::InputError;
using common::Problem;

std::string readText(const std::string& file) {
  std::error_code ignored;
  const bool regular = std::filesystem::is_regular_file(file, ignored);  // A folder opens as a stream, too.
  std::ifstream stream(file, std::ios::binary);
  if (!regular || !stream)
    throw InputError(Problem{{file}, "", "cannot be read", "give the path of an SDF world (.sdf or .world)"});
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Malformed XML is told by expat, which knows line and column; libsdformat tells it to the terminal only, and then
/// takes the file for URDF.
void requireSdf(const std::string& file, const std::string& text) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr), &XML_ParserFree);
  std::string root;
  XML_SetUserData(parser.get(), &root);
  XML_SetStartElementHandler(parser.get(), [](void* data, const XML_Char* name, const XML_Char**) {
    auto& first = *static_cast<std::string*>(data);
    if (first.empty()) first = name;
  });
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) != XML_STATUS_OK) {
    const auto line = static_cast<int>(XML_GetCurrentLineNumber(parser.get()));
    const auto column = static_cast<int>(XML_GetCurrentColumnNumber(parser.get())) + 1;
    throw InputError(Problem{{file, line, column},
                             "",
                             fmt::format("malformed XML: {}", XML_ErrorString(XML_GetErrorCode(parser.get()))),
                             ""});
  }
  if (root != "sdf") throw InputError(Problem{{file, 1}, root, "the root element of a world is <sdf>", ""});
}

/// Takes what libsdformat prints for as long as it lives. What fails as SDF it also tries as URDF, whose parser
/// complains on std::cerr; that is dropped.
class ConsoleCapture {
 public:
  ConsoleCapture()
      : stream_(sdf::Console::Instance()->GetMsgStream()),
        before_(stream_.GetStream()),
        cerr_before_(std::cerr.rdbuf(dropped_.rdbuf())) {
    stream_.SetStream(&text_);
  }
  ~ConsoleCapture() {
    stream_.SetStream(before_);
    std::cerr.rdbuf(cerr_before_);
  }
  ConsoleCapture(const ConsoleCapture&) = delete;
  ConsoleCapture& operator=(const ConsoleCapture&) = delete;

  /// Its lines without colours and without the place in libsdformat's own source.
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
  std::ostringstream dropped_;
  std::streambuf* cerr_before_;
  std::ostringstream text_;
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

/// These only repeat that something inside failed.
bool isEcho(const sdf::Error& error) {
  const std::string message = error.Message();
  return error.Code() == sdf::ErrorCode::FILE_READ || message.starts_with("Failed to load a world") ||
         message.starts_with("Error reading element");
}

std::string trimmed(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
  return text;
}

/// Where an error is; those of the frame graphs have no line, but name what they are about in brackets.
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
  // Only echoes: what happened was printed, the echo knows the line.
  if (sorted.problems.empty() && first_echo != nullptr && !(sorted.warnings.size() > 0 && console.empty())) {
    std::string message = trimmed(first_echo->Message());
    for (const std::string& line : console) message += ": " + line;
    sorted.problems.push_back({locate(*first_echo, file, text), "", message, ""});
  }
  return sorted;
}

/// libsdformat also throws, of several kinds.
sdf::Errors loadOrExplain(sdf::Root& root, const std::string& file, const sdf::ParserConfig& config) {
  try {
    return root.Load(file, config);
  } catch (const std::exception& exception) {
    throw InputError(Problem{{file}, "", fmt::format("libsdformat gave up: {}", exception.what()), ""});
  }
}

}  // namespace

SdfFile readSdf(const std::string& file, const UriResolver& resolver) {
  const std::string text = readText(file);
  requireSdf(file, text);

  sdf::ParserConfig config;
  config.SetFindCallback([&resolver](const std::string& uri) { return resolver.findInclude(uri); });
  config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::ERR);

  SdfFile result;
  const ConsoleCapture console;
  const sdf::Errors errors = loadOrExplain(result.root, file, config);
  Sorted sorted = sortErrors(errors, console.lines(), file, text);
  if (sorted.problems.empty() && result.root.WorldCount() == 0 && result.root.Model() == nullptr)
    sorted.problems.push_back({{file}, "sdf", "it has neither a <world> nor a <model>", ""});
  if (!sorted.problems.empty()) throw InputError(sorted.problems);
  result.warnings = std::move(sorted.warnings);
  result.wants_ground_plane = sorted.wants_ground_plane;
  return result;
}

}  // namespace swiftlet::simulation
