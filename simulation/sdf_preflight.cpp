#include "simulation/sdf_preflight.hpp"

#include <expat.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/read_bytes.hpp"

namespace swiftlet::simulation {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Problem;
using common::SourceLocation;

struct Include {
  std::string uri;
  int line = 0;
  int column = 0;
};

/// The parts of a file that the check reads.
struct Outline {
  std::string root;
  std::optional<std::string> version;
  std::vector<Include> includes;
  std::optional<Problem> malformed;
};

/// Follows one document; only a uri directly in an <include> is kept.
class OutlineReader {
 public:
  explicit OutlineReader(std::string file) : file_(std::move(file)) {}

  Outline read(const std::string& text) {
    const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr),
                                                                              &XML_ParserFree);
    parser_ = parser.get();
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(
        parser_,
        [](void* self, const XML_Char* name, const XML_Char** attributes) {
          static_cast<OutlineReader*>(self)->open(name, attributes);
        },
        [](void* self, const XML_Char*) { static_cast<OutlineReader*>(self)->close(); });
    XML_SetCharacterDataHandler(parser_, [](void* self, const XML_Char* text_part, int length) {
      static_cast<OutlineReader*>(self)->add({text_part, static_cast<std::size_t>(length)});
    });
    if (XML_Parse(parser_, text.data(), static_cast<int>(text.size()), XML_TRUE) != XML_STATUS_OK)
      outline_.malformed = Problem{{file_, line(), column()},
                                   "",
                                   fmt::format("malformed XML: {}", XML_ErrorString(XML_GetErrorCode(parser_))),
                                   ""};
    return std::move(outline_);
  }

 private:
  void open(const std::string& name, const XML_Char** attributes) {
    if (path_.empty()) {
      outline_.root = name;
      for (; *attributes != nullptr; attributes += 2)
        if (std::string_view(attributes[0]) == "version") outline_.version = attributes[1];
    }
    in_uri_ = name == "uri" && !path_.empty() && path_.back() == "include";
    if (in_uri_) outline_.includes.push_back({"", line(), column()});
    path_.push_back(name);
  }
  void close() {
    path_.pop_back();
    in_uri_ = false;
  }
  void add(std::string_view text) {
    if (in_uri_) outline_.includes.back().uri += text;
  }
  int line() const { return static_cast<int>(XML_GetCurrentLineNumber(parser_)); }
  int column() const { return static_cast<int>(XML_GetCurrentColumnNumber(parser_)) + 1; }

  std::string file_;
  XML_Parser parser_ = nullptr;
  Outline outline_;
  std::vector<std::string> path_;
  bool in_uri_ = false;
};

std::string trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1));
}

/// A version such as "1.9".
bool isVersion(const std::string& text) {
  const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  return text.size() == 3 && digit(text[0]) && text[1] == '.' && digit(text[2]);
}

/// The files that an include may load: the file itself, or in a model's folder every SDF file, of which libsdformat
/// picks one.
std::vector<fs::path> filesOf(const fs::path& included) {
  std::error_code ignored;
  if (!fs::is_directory(included, ignored)) return {included};
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(included, ignored))
    if (entry.path().extension() == ".sdf") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class CircleFinder {
 public:
  explicit CircleFinder(const UriResolver& resolver) : resolver_(resolver) {}

  void follow(const fs::path& file, const Outline& outline) {
    const fs::path real = canonical(file);
    open_.push_back(real);
    for (const Include& include : outline.includes) {
      const std::string uri = trimmed(include.uri);
      for (const fs::path& next :
           filesOf(resolver_.find(uri).value_or(uri)))  // An unresolved uri may be a path below the working folder.
        visit(next, {file.string(), include.line, include.column});
    }
    open_.pop_back();
    closed_.insert(real);
  }

 private:
  static fs::path canonical(const fs::path& file) {
    std::error_code failure;
    fs::path path = fs::canonical(file, failure);
    return failure ? file : path;
  }

  void visit(const fs::path& file, const SourceLocation& from) {
    const fs::path real = canonical(file);
    if (closed_.contains(real)) return;
    if (std::find(open_.begin(), open_.end(), real) != open_.end())
      throw InputError(Problem{from, "include",
                               fmt::format("files include each other: {} leads back to itself", file.string()), ""});
    std::error_code ignored;
    if (!fs::is_regular_file(real, ignored)) return;
    follow(file, OutlineReader(file.string()).read(common::readBytes(file)));
  }

  const UriResolver& resolver_;
  std::vector<fs::path> open_;  ///< The chain of files from the world to the present one.
  std::set<fs::path> closed_;   ///< Files that were found sound.
};

}  // namespace

void checkBeforeSdf(const std::string& file, const std::string& text, const UriResolver& resolver) {
  const Outline outline = OutlineReader(file).read(text);
  if (outline.malformed) throw InputError(*outline.malformed);
  if (outline.root != "sdf")
    throw InputError(Problem{{file, 1}, outline.root, "the root element of a world is <sdf>", ""});
  if (!outline.version || !isVersion(*outline.version))
    throw InputError(Problem{{file, 1},
                             "sdf",
                             fmt::format("the version `{}` is none of SDF", outline.version.value_or("")),
                             "expected is version=\"1.9\" or another from 1.0 on"});
  CircleFinder(resolver).follow(file, outline);
}

}  // namespace swiftlet::simulation
