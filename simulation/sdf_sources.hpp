// A world and the files that it includes, in a form that libsdformat 12 reads.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.hpp"
#include "simulation/sdf_text.hpp"
#include "simulation/uri_resolver.hpp"

namespace swiftlet::simulation {

/// The only link of a model that stands for an include that was not found.
inline constexpr const char* kStandInLink = "stand_in";

/// Follows all includes. Where libsdformat could not read a file as it is (another encoding, a version after 1.9) or
/// would search an include elsewhere, it gets a copy, line for line the same, with what it needs instead. The copies
/// are removed with this object.
class SdfSources {
 public:
  /// Throws common::InputError for malformed XML, which libsdformat reports only on the terminal; for templates; for a
  /// root element or a version that SDF does not have; and for files that include each other in a circle, which
  /// libsdformat follows until the memory is full.
  SdfSources(const std::string& file, const UriResolver& resolver);

  /// The world's file, or its copy.
  const std::string& toRead() const { return to_read_; }
  /// The file that a path is the copy of, or the path itself.
  std::string originalOf(const std::string& path) const;
  /// A message in which copies have the names of their originals.
  std::string withOriginals(std::string message) const;

  /// Things that the world names and that are not found, each with its place; without them it is incomplete. A
  /// model without anything stands for an include that was not found.
  const std::vector<common::Problem>& missing() const { return missing_; }
  const std::vector<common::Problem>& warnings() const { return warnings_; }
  bool wantsGroundPlane() const { return wants_ground_plane_; }

 private:
  /// Removed with everything in it.
  struct CopiesFolder {
    CopiesFolder() = default;
    ~CopiesFolder();
    CopiesFolder(const CopiesFolder&) = delete;
    CopiesFolder& operator=(const CopiesFolder&) = delete;

    std::filesystem::path path;  ///< Empty while there are no copies.
  };

  /// A file while it is followed.
  struct Document {
    std::string file;
    std::string text;
    std::vector<SdfTag> tags;
    /// Parts of the text and what replaces them, in the order of the text.
    std::map<std::size_t, std::pair<std::size_t, std::string>> edits;
    std::set<std::string> stand_ins;

    common::SourceLocation locationOf(const SdfTag& tag) const { return locationIn(file, text, tag.begin); }
    const SdfTag* child(std::size_t parent, std::string_view name) const;
    void replace(std::size_t begin, std::size_t end, const std::string& by);
  };

  std::string visit(const std::string& file, const common::SourceLocation& from);
  std::string prepare(Document& document, const std::string& bytes);
  void checkVersion(Document& document);
  bool isTemplate(const Document& document);
  void followInclude(Document& document, std::size_t number);
  void mergeIntoWorld(Document& document, std::size_t number, const std::string& path);
  void standIn(Document& document, std::size_t number, const std::string& uri);
  void reportMissing(const Document& document, const SdfTag& uri_tag, const std::string& uri, const std::string& hint);
  std::string asItIs(const Document& document);
  std::string copy(const Document& document);

  const UriResolver& resolver_;
  std::string to_read_;
  CopiesFolder folder_;
  std::map<std::string, std::string> originals_;       ///< The files as they were named, by what is read for them.
  std::map<std::filesystem::path, std::string> done_;  ///< What to read, by the canonical path of the file.
  std::vector<std::filesystem::path> open_;            ///< The chain of files from the world to the present one.
  std::set<std::string> reported_;
  std::vector<common::Problem> missing_, warnings_;
  bool wants_ground_plane_ = false;
};

}  // namespace swiftlet::simulation
