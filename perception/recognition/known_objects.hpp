// What a profile looks for: openings, printed patterns and tags, behind the one interface.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "common/config_fwd.hpp"
#include "common/error.hpp"
#include "perception/recognition/opening_recognizer.hpp"
#include "perception/recognition/recognizer.hpp"

namespace swiftlet::perception {

/// The name under which windows and doors are looked for.
inline constexpr const char* kOpenings = "openings";

/// One line of the list: `openings`, or a pattern by a picture or as a tag.
struct KnownObjectConfig {
  std::string name;
  std::string picture;
  int tag = -1;
  double width_m = 0.0;
  /// Bytes of the file `picture`, which who reads the profile reads too. Not a setting.
  std::string picture_bytes = {};

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
  bool isPattern() const { return name != kOpenings; }
};

/// Not thread-safe: a thread has its own.
class KnownObjects final : public Recognizer {
 public:
  /// Fails for a picture that cannot be read or shows no place; the element of the problem is the pattern's name.
  static tl::expected<KnownObjects, common::Problem> create(const std::vector<KnownObjectConfig>& configs,
                                                            const OpeningConfig& openings);

  /// What all recognizers find, in the order of the list, with the size of each pattern.
  std::vector<Recognized> recognize(const Observation& observation) override;

  /// Whether it looks at grey pictures.
  bool needsPicture() const { return !patterns_.empty(); }
  bool needsDepths() const { return openings_ != nullptr; }

 private:
  /// A pattern's size by its name.
  struct Known {
    std::string name;
    Eigen::Vector2d size_m;
  };
  std::unique_ptr<OpeningRecognizer> openings_;  ///< Null if they are not looked for.
  std::vector<std::unique_ptr<Recognizer>> recognizers_;
  std::vector<Known> patterns_;
};

}  // namespace swiftlet::perception
