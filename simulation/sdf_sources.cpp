#include "simulation/sdf_sources.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "common/lower_case.hpp"
#include "common/markup.hpp"
#include "common/misleading.hpp"
#include "common/read_bytes.hpp"
#include "simulation/sdf_encoding.hpp"
#include "simulation/sdf_numbers.hpp"

namespace swiftlet::simulation {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Message;
using common::Problem;

/// "Ground Plane" and "ground_plane" are the same.
std::string plainWords(std::string_view words) {
  std::string text = common::lowerCase(words);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

/// The name of the model that a URI ends with.
std::string nameIn(const std::string& uri) {
  if (const auto address = fuelAddress(uri)) return address->name;
  return fs::path(percentDecoded(uri)).filename().string();
}

/// The minor version of "1.9"; nullopt for other texts.
std::optional<int> minorVersion(std::string_view text) {
  const bool digits = text.size() > 2 && text.size() < 5 &&
                      std::all_of(text.begin() + 2, text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  if (!digits || !text.starts_with("1.")) return std::nullopt;
  return std::atoi(std::string(text.substr(2)).c_str());
}

constexpr int kNewestMinorVersion = 9;  // Of libsdformat 12.

/// The file of a model's folder: the newest readable version by model.config, or model.sdf.
std::optional<fs::path> modelFileIn(const fs::path& folder) {
  std::error_code ignored;
  for (const char* config : {"model.config", "manifest.xml"}) {
    if (!fs::is_regular_file(folder / config, ignored)) continue;
    const std::string text = utf8Text((folder / config).string(), common::readText(folder / config));
    const auto tags = readTags((folder / config).string(), text);
    if (!tags) throw InputError(tags.error());
    std::string best;
    int best_version = -1;
    for (const SdfTag& tag : *tags) {
      if (tag.name != "sdf") continue;
      const int version = minorVersion(attributeOf(tag, "version").value_or("")).value_or(0);
      if (!best.empty() && (version > kNewestMinorVersion || version <= best_version)) continue;
      best = textOf(tag, text);
      best_version = version > kNewestMinorVersion ? -1 : version;
    }
    if (!best.empty()) return folder / best;
  }
  if (fs::is_regular_file(folder / "model.sdf", ignored)) return folder / "model.sdf";
  return std::nullopt;
}

fs::path canonical(const fs::path& file) {
  std::error_code failure;
  fs::path path = fs::canonical(file, failure);
  return failure ? file : path;
}

/// Elsewhere, such as in a <plugin>, an <include> is not SDF's.
bool mayInclude(const std::vector<SdfTag>& tags, int parent) {
  for (; parent >= 0; parent = tags[static_cast<std::size_t>(parent)].parent) {
    const std::string_view name = tags[static_cast<std::size_t>(parent)].name;
    if (name != "sdf" && name != "world" && name != "model" && name != "population") return false;
  }
  return true;
}

bool isIn(const std::vector<SdfTag>& tags, const SdfTag& tag, std::string_view parent) {
  return tag.parent >= 0 && tags[static_cast<std::size_t>(tag.parent)].name == parent;
}

}  // namespace

const SdfTag* SdfSources::Document::child(std::size_t parent, std::string_view name) const {
  for (std::size_t i = parent + 1; i < tags.size() && tags[i].begin < tags[parent].end; ++i)
    if (tags[i].parent == static_cast<int>(parent) && tags[i].name == name) return &tags[i];
  return nullptr;
}

/// The lines after it keep their numbers.
void SdfSources::Document::replace(std::size_t begin, std::size_t end, const std::string& by) {
  const auto from = text.begin() + static_cast<std::ptrdiff_t>(begin),
             to = text.begin() + static_cast<std::ptrdiff_t>(end);
  const auto lines = std::count(from, to, '\n') - std::count(by.begin(), by.end(), '\n');
  edits[begin] = {end, by + std::string(static_cast<std::size_t>(std::max<std::ptrdiff_t>(lines, 0)), '\n')};
}

SdfSources::SdfSources(const std::string& file, const UriResolver& resolver) : resolver_(resolver) {
  to_read_ = visit(file, {});
}

SdfSources::CopiesFolder::~CopiesFolder() {
  std::error_code ignored;
  if (!path.empty()) fs::remove_all(path, ignored);
}

std::string SdfSources::originalOf(const std::string& path) const {
  const auto found = originals_.find(path);
  return found == originals_.end() ? path : found->second;
}

std::string SdfSources::withOriginals(std::string message) const {
  for (const auto& [copy, original] : originals_)
    for (std::size_t at = 0; (at = message.find(copy, at)) != std::string::npos; at += original.size())
      message.replace(at, copy.size(), original);
  return message;
}

/// What libsdformat is to read in place of `file`, which is included at `from`.
std::string SdfSources::visit(const std::string& file, const common::SourceLocation& from) {
  const fs::path real = canonical(file);
  if (const auto known = done_.find(real); known != done_.end()) return known->second;
  if (std::find(open_.begin(), open_.end(), real) != open_.end())
    throw InputError(from, "include",
                     Message("sdf.include-circle", "files include each other: {} leads back to itself", file));
  open_.push_back(real);
  Document document{file, {}, {}, {}, {}};
  std::string result = prepare(document, common::readText(file));
  open_.pop_back();
  return done_[real] = std::move(result);
}

std::string SdfSources::prepare(Document& document, const std::string& bytes) {
  document.text = utf8Text(document.file, bytes);
  auto tags = readTags(document.file, document.text);
  if (const std::size_t ruby = document.text.find("<%"); !tags && ruby != std::string::npos)
    throw InputError(locationIn(document.file, document.text, ruby), "",
                     Message("sdf.erb-template", "is a template of ERB (embedded Ruby), which is not evaluated"),
                     fmt::format("make the world of it: erb \"{}\" > world.sdf", document.file));
  if (!tags) throw InputError(tags.error());
  document.tags = *std::move(tags);
  const std::string root(document.tags.front().name);
  if (root != "sdf" && open_.size() > 1) return asItIs(document);  // libsdformat reads URDF models.
  if (root != "sdf")
    throw InputError({document.file, 1}, root, Message("sdf.other-root", "the root element of a world is <sdf>"));
  checkVersion(document);
  if (!isTemplate(document))  // The numbers of one may be expressions.
    if (const auto problems = numberProblems(document.file, document.text, document.tags); !problems.empty())
      throw InputError(problems);
  for (std::size_t i = 0; i < document.tags.size(); ++i)
    if (document.tags[i].name == "include" && mayInclude(document.tags, document.tags[i].parent))
      followInclude(document, i);
  if (document.edits.empty() && document.text == bytes) return asItIs(document);
  return copy(document);
}

void SdfSources::checkVersion(Document& document) {
  const auto version = attributeOf(document.tags.front(), "version");
  const auto minor = minorVersion(version.value_or(""));
  if (!minor) {
    std::string hint = common::misleadingHint(document.tags.front().attributes);
    if (hint.empty()) hint = "expected is version=\"1.9\" or another from 1.0 on";
    throw InputError({document.file, 1}, "sdf",
                     Message("sdf.no-version", "`{}` is not a version of SDF", version.value_or("")), hint);
  }
  if (*minor <= kNewestMinorVersion) return;
  warnings_.push_back({document.locationOf(document.tags.front()), "sdf",
                       Message("sdf.newer-version", "version {} is read by the rules of 1.9", *version), ""});
  const auto begin = static_cast<std::size_t>(version->data() - document.text.data());
  document.replace(begin, begin + version->size(), "1.9");
}

/// A template's elements hold things that only its tool can place; they are missing then.
bool SdfSources::isTemplate(const Document& document) {
  constexpr std::array<std::string_view, 4> kValues{"xacro:arg", "xacro:property", "xacro:if", "xacro:unless"};
  constexpr std::array<std::string_view, 5> kThings{"model", "include", "link", "collision", "visual"};
  const auto among = [](const auto& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const SdfTag& tag : document.tags) {
    if (!tag.name.starts_with("xacro:")) continue;
    const bool holds = std::any_of(document.tags.begin(), document.tags.end(), [&](const SdfTag& inner) {
      return inner.begin > tag.begin && inner.end <= tag.content_end && among(kThings, inner.name);
    });
    if (!holds && among(kValues, tag.name)) continue;
    missing_.push_back({document.locationOf(tag), std::string(tag.name),
                        Message("sdf.xacro-template", "the file is a template of xacro, which is not evaluated"),
                        fmt::format("make the world of it: xacro \"{}\" > world.sdf", document.file)});
    return true;
  }
  return false;
}

void SdfSources::followInclude(Document& document, std::size_t number) {
  const SdfTag& include = document.tags[number];
  const SdfTag* uri_tag = document.child(number, "uri");
  const std::string uri = uri_tag == nullptr ? "" : textOf(*uri_tag, document.text);
  if (uri.empty()) {
    missing_.push_back({document.locationOf(include), "include", Message("sdf.include-without-uri", "has no <uri>"),
                        "name what is to be included"});
    return document.replace(include.begin, include.end, "");
  }
  auto found = resolver_.find(uri, document.file);
  std::string hint;
  if (!found)
    hint = resolver_.hintFor(uri, document.file);
  else if (fs::is_directory(*found) && !(found = modelFileIn(*found)))
    hint = "its folder has no model.config and no model.sdf";
  std::error_code ignored;
  if (found && !fs::is_regular_file(*found, ignored)) {
    hint = fmt::format("{} is no file", found->string());
    found.reset();
  }
  // libsdformat takes the text of these without looking whether there is any.
  for (const char* name : {"name", "static", "placement_frame"})
    if (const SdfTag* tag = document.child(number, name); tag != nullptr && textOf(*tag, document.text).empty())
      document.replace(tag->begin, tag->end, "");
  if (found) {
    const std::string path = visit(found->string(), document.locationOf(*uri_tag));
    const std::string_view merge = attributeOf(include, "merge").value_or("");
    if ((merge == "true" || merge == "1") && isIn(document.tags, include, "world"))
      mergeIntoWorld(document, number, path);
    return document.replace(uri_tag->content, uri_tag->content_end, common::escaped(path));
  }
  reportMissing(document, *uri_tag, uri, hint);
  standIn(document, number, uri);
}

/// libsdformat 12 merges into models alone. In a world the model is included as it is, and frames give what is in it
/// the names that it would have.
void SdfSources::mergeIntoWorld(Document& document, std::size_t number, const std::string& path) {
  const SdfTag& include = document.tags[number];
  const auto merge = *attributeOf(include, "merge");
  const auto value = static_cast<std::size_t>(merge.data() - document.text.data());
  document.replace(document.text.rfind("merge", value), value + merge.size() + 1, "");
  const std::string text = common::readBytes(path);  // As prepare() left it.
  const auto tags = readTags(path, text);
  if (!tags) return;
  const auto model = std::find_if(tags->begin(), tags->end(), [](const SdfTag& tag) { return tag.name == "model"; });
  if (model == tags->end()) return;
  const SdfTag* name_tag = document.child(number, "name");
  const std::string scope = name_tag != nullptr ? common::escaped(textOf(*name_tag, document.text))
                                                : std::string(attributeOf(*model, "name").value_or(""));
  std::string frames = "</include>";
  for (const SdfTag& part : *tags)
    if (const auto name = attributeOf(part, "name");
        name && part.parent == model - tags->begin() && (part.name == "model" || part.name == "frame"))
      frames += fmt::format("<frame name=\"{0}\" attached_to=\"{1}::{0}\"/>", *name, scope);
  document.replace(include.content_end, include.end, frames);
}

/// In place of an include that was not found: other things may be placed relative to it.
void SdfSources::standIn(Document& document, std::size_t number, const std::string& uri) {
  const SdfTag& include = document.tags[number];
  if (nameIn(plainWords(uri)) == "sun" || attributeOf(include, "merge"))
    return document.replace(include.begin, include.end, "");
  const SdfTag* name_tag = document.child(number, "name");
  std::string name = name_tag != nullptr ? textOf(*name_tag, document.text) : nameIn(uri);
  if (name.empty()) name = "stand_in";
  if (!document.stand_ins.insert(name).second && name_tag == nullptr) name += fmt::format("_{}", number);
  const SdfTag* pose = document.child(number, "pose");
  document.replace(
      include.begin, include.end,
      fmt::format("<model name=\"{}\">{}<static>1</static><link name=\"{}\"/></model>", common::escaped(name),
                  pose == nullptr ? "" : document.text.substr(pose->begin, pose->end - pose->begin), kStandInLink));
}

void SdfSources::reportMissing(const Document& document, const SdfTag& uri_tag, const std::string& uri,
                               const std::string& hint) {
  Problem problem{{document.file, document.locationOf(uri_tag).line},
                  "",
                  Message("sdf.not-found", "Unable to find uri[{}]", uri),
                  ""};
  const bool floor = plainWords(nameIn(uri)).find("ground plane") != std::string::npos;
  if (floor) {
    wants_ground_plane_ = true;
    problem.message += "; a floor at z = 0 stands in for it";
  }
  if (floor || plainWords(nameIn(uri)) == "sun") {
    warnings_.push_back(std::move(problem));
  } else if (reported_.insert(uri).second) {  // Once is enough for a model that is included a hundred times.
    problem.hint = hint;
    missing_.push_back(std::move(problem));
  }
}

/// A relative path libsdformat would search elsewhere first: world.sdf is one of its own files.
std::string SdfSources::asItIs(const Document& document) {
  const std::string path = fs::absolute(document.file).string();
  originals_[path] = document.file;
  return path;
}

std::string SdfSources::copy(const Document& document) {
  const auto refuse = [](const fs::path& folder, Message message) {
    throw InputError({folder.string()}, "", std::move(message), "set TMPDIR to another folder");
  };
  if (folder_.path.empty()) {
    std::error_code failure;
    std::string name = (fs::temp_directory_path(failure) / "swiftlet-sdf-XXXXXX").string();
    if (failure || ::mkdtemp(name.data()) == nullptr)
      refuse(name, Message("sdf.no-folder", "the folder for the world's files cannot be made"));
    folder_.path = name;
  }
  std::string text;
  std::size_t at = 0;
  for (const auto& [begin, edit] : document.edits) {
    if (begin < at) continue;  // Inside a part that is replaced as a whole.
    text.append(document.text, at, begin - at).append(edit.second);
    at = edit.first;
  }
  text.append(document.text, at);
  const std::string path = (folder_.path / fmt::format("{}.sdf", originals_.size())).string();
  std::ofstream stream(path, std::ios::binary);
  stream << text << std::flush;
  if (!stream) refuse(folder_.path, Message("sdf.no-copy", "the copy of a world's file cannot be written there"));
  originals_[path] = document.file;
  return path;
}

}  // namespace swiftlet::simulation
