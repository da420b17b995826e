// What a profile looks for: openings, printed patterns, tags and houses, behind the one interface.
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

/// One line of the list: `openings`, a pattern by a picture or as a tag, or a house by the file of its model.
struct KnownObjectConfig {
  std::string name;
  std::string picture;
  int tag = -1;
  double width_m = 0.0;
  /// Bytes of the file `picture`, which who reads the profile reads too. Not a setting.
  std::string picture_bytes = {};

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
  /// Something with a name of its own, which a camera sees: a house too.
  bool isPattern() const { return name != kOpenings; }
  bool isHouse() const { return picture.ends_with(".yaml"); }
};

/// Not thread-safe: a thread has its own.
class KnownObjects final : public Recognizer {
 public:
  /// Fails for a picture that cannot be read or shows no place, and for a model of no house; the element of the problem
  /// is the pattern's name. Of `openings` the noise and the range of the depths are those of houses too.
  static tl::expected<KnownObjects, common::Problem> create(const std::vector<KnownObjectConfig>& configs,
                                                            const OpeningConfig& openings);

  /// What all recognizers find, openings first, with the size of each pattern and house.
  std::vector<Recognized> recognize(const Observation& observation) override;

  /// Whether it looks at grey pictures.
  bool needsPicture() const { return !patterns_.empty(); }
  bool needsDepths() const { return openings_ != nullptr; }

 private:
  /// The size of a pattern or a house by its name.
  struct Known {
    std::string name;
    Eigen::Vector2d size_m;
  };
  std::unique_ptr<OpeningRecognizer> openings_;  ///< Null if they are not looked for.
  std::vector<std::unique_ptr<Recognizer>> recognizers_;
  std::vector<Known> patterns_;
};

}  // namespace swiftlet::perception
