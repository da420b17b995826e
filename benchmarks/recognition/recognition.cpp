// benchmark_recognition [--pictures N] [--seed N] [--backgrounds FOLDER] [--pattern landing | shapes | FILE]
//
// Renders scenes with a pattern and the same with an AprilTag in its place, half of them with decoys only, and counts
// what each recognizer finds. With --openings, rooms of random houses instead, written or held-back; with --houses,
// yards with a house of known shape. The tables of docs/recognition.md.
#include <ctime>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <Eigen/LU>

#include "benchmarks/recognition/houses.hpp"
#include "benchmarks/recognition/openings.hpp"
#include "common/image_decoder.hpp"
#include "common/png_encoder.hpp"
#include "common/quantile.hpp"
#include "common/read_bytes.hpp"
#include "common/table.hpp"
#include "perception/recognition/histogram_recognizer.hpp"
#include "perception/recognition/pattern_recognizer.hpp"
#include "perception/recognition/tag_recognizer.hpp"
#include "tests/recognition/pattern_scene.hpp"

namespace {

using namespace swiftlet;
using perception::CameraPicture;
using perception::PatternScene;
using perception::Recognized;
using perception::Recognizer;
using vision::GrayImage;

/// Only the ratio of distance and printed size appears in a picture.
constexpr double kWidth_m = 0.5;
constexpr int kPrintSide_px = 400;
/// The tag with its white margin has 10 cells, the black border 8.
constexpr double kBorderShare = 0.8;
constexpr int kTagId = 17;
/// A pose is right if the corners of the sheet are off by less than this share of the pattern's size on average. What
/// is farther off is a false one.
constexpr double kRightShare = 0.1;
/// Patterns that cover less are counted apart.
constexpr double kCovered_px = 40.0;

struct Options {
  std::uint64_t pictures = 200, seed = 1, first = 0;
  std::string backgrounds, pattern = "landing", dump, only, openings, houses;
  bool verbose = false, tracked = false;
};

double processorSeconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

GrayImage readGrey(const std::filesystem::path& file) {
  const auto image = common::decodeGrey(common::readBytes(file));
  if (!image) throw std::runtime_error(file.string() + " " + image.error().reason.text());
  return {image->width_px, image->height_px, image->brightness};
}

std::vector<GrayImage> readBackgrounds(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  if (!folder.empty())
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<GrayImage> backgrounds;
  for (const auto& file : files) backgrounds.push_back(readGrey(file));
  return backgrounds;
}

/// The middle of a picture, square.
GrayImage square(const GrayImage& picture) {
  const int side = std::min(picture.width_px, picture.height_px);
  const int left = (picture.width_px - side) / 2, top = (picture.height_px - side) / 2;
  GrayImage middle{side, side, {}};
  for (int v = 0; v < side; ++v)
    middle.values.insert(middle.values.end(), picture.row(top + v) + left, picture.row(top + v) + left + side);
  return middle;
}

/// What one recognizer did.
struct Contender {
  std::string name;
  bool takes_tag = false;
  std::unique_ptr<Recognizer> recognizer;
  int right = 0, wrong = 0, wrong_beside = 0;
  std::vector<double> milliseconds;
  std::array<int, 2> right_hidden{};                         ///< Of the large ones: nothing hidden, a part hidden.
  std::array<int, 6> right_of{};                             ///< By classes of size.
  std::vector<std::optional<std::array<double, 3>>> errors;  ///< One a scene with the pattern: position share, deg, px.
  std::vector<double> nees;
};

constexpr std::array<double, 6> kSizes_px = {20.0, 30.0, 40.0, 60.0, 100.0, 1e9};

std::size_t sizeClass(double size_px) {
  return static_cast<std::size_t>(std::upper_bound(kSizes_px.begin(), kSizes_px.end(), size_px) - kSizes_px.begin());
}

double cornerError_px(const common::Pose3& estimate, const common::Pose3& truth) {
  const common::PinholeCamera camera = perception::sceneCamera();
  double sum = 0.0;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5}) {
      const Eigen::Vector3d corner(x * kWidth_m, y * kWidth_m, 0.0);
      const Eigen::Vector3d seen = estimate * corner;
      if (seen.x() <= 0.0) return 1e9;
      sum += 0.25 * (camera.pixel(seen) - camera.pixel(truth * corner)).norm();
    }
  return sum;
}

void look(Contender& contender, const PatternScene& scene, const CameraPicture& picture) {
  const double begin_s = processorSeconds();
  const std::vector<Recognized> found = contender.recognizer->recognize({&picture, nullptr});
  contender.milliseconds.push_back(1e3 * (processorSeconds() - begin_s));
  if (scene.has_pattern) contender.errors.emplace_back();
  bool is_right = false;
  for (const Recognized& one : found) {
    const common::Pose3& truth = scene.pattern.T_camera_sheet;
    const double error_px = scene.has_pattern ? cornerError_px(one.T_sensor_object, truth) : 1e9;
    if (!scene.has_pattern || error_px > kRightShare * scene.pattern.size_px || is_right) {
      ++(scene.has_pattern ? contender.wrong_beside : contender.wrong);
      continue;
    }
    is_right = true;
    ++contender.right;
    ++contender.right_of[sizeClass(scene.pattern.size_px)];
    if (scene.pattern.size_px >= kCovered_px) ++contender.right_hidden[scene.occluded_share > 0.0 ? 1 : 0];
    const Eigen::Vector3d turned = common::logSO3(truth.rotation * one.T_sensor_object.rotation.conjugate());
    const Eigen::Vector3d off = truth.position_m - one.T_sensor_object.position_m;
    contender.errors.back() = {off.norm() / truth.position_m.norm(), turned.norm() * 57.29577951308232, error_px};
    Eigen::Matrix<double, 6, 1> error;
    error << turned, off;
    contender.nees.push_back(error.dot(one.covariance.inverse() * error) / 6.0);
  }
}

void dump(const Options& options, const PatternScene& scene, const CameraPicture& picture, const char* what) {
  common::Image image{picture.gray.width_px, picture.gray.height_px, {}};
  for (const std::uint8_t value : picture.gray.values) image.rgb.insert(image.rgb.end(), 3, value);
  const auto png = common::encodePng(image, common::ImageContent::kPhoto);
  const std::string path = fmt::format("{}/{}_{:04}.png", options.dump, what, scene.index);
  if (std::FILE* const file = std::fopen(path.c_str(), "wb")) {
    std::fwrite(png.data(), 1, png.size(), file);
    std::fclose(file);
  }
}

std::string percent(int part, int whole) {
  return whole > 0 ? fmt::format("{:.1f}", 100.0 * part / whole) : std::string("-");
}

/// Median and 90th percentile over the scenes that both found and that are large enough.
std::string errorText(const std::vector<double>& values, int digits) {
  if (values.empty()) return "-";
  return fmt::format("{:.{}f} / {:.{}f}", common::quantile(values, 0.5), digits, common::quantile(values, 0.9), digits);
}

int run(const Options& options) {
  GrayImage print = options.pattern == "landing"  ? perception::landingMark(kPrintSide_px)
                    : options.pattern == "shapes" ? perception::shapesDrawing(kPrintSide_px)
                                                  : square(readGrey(options.pattern));
  const auto pattern = perception::PatternTemplate::create(options.pattern, print, kWidth_m);
  if (!pattern) {
    std::fprintf(stderr, "%s: %s\n", options.pattern.c_str(), pattern.error().text().c_str());
    return 2;
  }
  const std::vector<GrayImage> backgrounds = readBackgrounds(options.backgrounds);
  perception::Prints prints{print, perception::landingDecoys(kPrintSide_px)};
  prints.decoys.push_back(perception::mirrored(print));
  perception::Prints tags{perception::drawTag(kTagId, 40), {}};
  for (int id = 18; id < 26; ++id) tags.decoys.push_back(perception::drawTag(id, 40));
  tags.decoys.push_back(perception::mirrored(tags.pattern));

  std::vector<Contender> contenders(3);
  contenders[0].name = "Tomic 2012";
  contenders[0].recognizer = std::make_unique<perception::HistogramRecognizer>(*pattern);
  contenders[1].name = "ours";
  auto ours = std::make_unique<perception::PatternRecognizer>(*pattern);
  std::printf("%zu shapes known\n", ours->shapes().size());
  contenders[1].recognizer = std::move(ours);
  contenders[2].name = "AprilTag 36h11";
  contenders[2].takes_tag = true;
  contenders[2].recognizer = std::make_unique<perception::TagRecognizer>(
      *perception::TagRecognizer::create({{"tag", kTagId, kBorderShare * kWidth_m}}));

  std::array<int, 6> scenes_of{};
  std::array<int, 2> scenes_hidden{};
  std::vector<double> sizes;
  int with = 0;
  for (std::uint64_t i = options.first; i < options.first + options.pictures; ++i) {
    const PatternScene scene = perception::drawScene(options.seed, i, kWidth_m);
    if (scene.has_pattern) {
      ++with;
      ++scenes_of[sizeClass(scene.pattern.size_px)];
      if (scene.pattern.size_px >= kCovered_px) ++scenes_hidden[scene.occluded_share > 0.0 ? 1 : 0];
      sizes.push_back(scene.pattern.size_px);
    }
    const CameraPicture picture = perception::render(scene, prints, backgrounds);
    const CameraPicture tag_picture = perception::render(scene, tags, backgrounds);
    if (!options.dump.empty()) {
      dump(options, scene, picture, "pattern");
      dump(options, scene, tag_picture, "tag");
    }
    for (Contender& contender : contenders)
      if (options.only.empty() || contender.takes_tag || contender.name.find(options.only) != std::string::npos)
        look(contender, scene, contender.takes_tag ? tag_picture : picture);
  }

  const auto pair_errors = [&](const Contender& one, const Contender& other, std::size_t what, double scale) {
    std::vector<double> values;
    for (std::size_t i = 0; i < std::min(one.errors.size(), other.errors.size()); ++i)
      if (sizes[i] >= kCovered_px && one.errors[i] && other.errors[i]) values.push_back(scale * (*one.errors[i])[what]);
    return values;
  };
  std::printf("\npattern %s, seed %d, %d pictures, %d with the pattern\n\n", options.pattern.c_str(),
              static_cast<int>(options.seed), static_cast<int>(options.pictures), with);
  std::printf("| | %s | %s | %s |\n| --- | --- | --- | --- |\n", contenders[0].name.c_str(), contenders[1].name.c_str(),
              contenders[2].name.c_str());
  const auto row = [&](const std::string& name, const auto& cell) {
    std::printf("| %s |", name.c_str());
    for (const Contender& contender : contenders) std::printf(" %s |", cell(contender).c_str());
    std::printf("\n");
  };
  row("precision, %", [](const Contender& c) {
    const int all = c.right + c.wrong + c.wrong_beside;
    return all > 0 ? fmt::format("{:.2f}", 100.0 * c.right / all) : std::string("-");
  });
  row("false in pictures without / with the pattern",
      [](const Contender& c) { return fmt::format("{} / {}", c.wrong, c.wrong_beside); });
  row("recall, 40 px and more, %", [&](const Contender& c) {
    return percent(c.right_of[3] + c.right_of[4] + c.right_of[5], scenes_of[3] + scenes_of[4] + scenes_of[5]);
  });
  for (const std::size_t hidden : {0U, 1U})
    row(fmt::format("of these, {} ({}), %", hidden == 0 ? "nothing hidden" : "a part hidden", scenes_hidden[hidden]),
        [&](const Contender& c) { return percent(c.right_hidden[hidden], scenes_hidden[hidden]); });
  const std::array<std::string, 6> names = {
      "", "20 to 30 px", "30 to 40 px", "40 to 60 px", "60 to 100 px", "above 100 px"};
  for (std::size_t k = 1; k < names.size(); ++k)
    row(fmt::format("recall, {} ({}), %", names[k], scenes_of[k]),
        [&](const Contender& c) { return percent(c.right_of[k], scenes_of[k]); });
  const Contender& tag = contenders[2];
  const Contender& best = contenders[1];
  const auto beside = [&](const Contender& c) -> const Contender& { return &c == &tag ? best : tag; };
  row("position error, % of the distance, median / 90 %",
      [&](const Contender& c) { return errorText(pair_errors(c, beside(c), 0, 100.0), 2); });
  row("rotation error, deg, median / 90 %",
      [&](const Contender& c) { return errorText(pair_errors(c, beside(c), 1, 1.0), 2); });
  row("corners, px, median / 90 %",
      [&](const Contender& c) { return errorText(pair_errors(c, beside(c), 2, 1.0), 2); });
  row("error squared over its covariance, median / 90 % (1 is right)",
      [](const Contender& c) { return errorText(c.nees, 2); });
  row("ms a picture, mean / 99 %", [](const Contender& c) {
    if (c.milliseconds.empty()) return std::string("-");
    double sum = 0.0;
    for (const double ms : c.milliseconds) sum += ms;
    return fmt::format("{:.0f} / {:.0f}", sum / static_cast<double>(c.milliseconds.size()),
                       common::quantile(c.milliseconds, 0.99));
  });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Recognition of a printed pattern and of an AprilTag in its place");
  Options options;
  app.add_option("--pictures", options.pictures, "Number of pictures; half of them show the pattern");
  app.add_option("--seed", options.seed, "Of the scenes");
  app.add_option("--first", options.first, "Index of the first scene");
  app.add_option("--backgrounds", options.backgrounds, "Folder of PNG and JPEG pictures behind the sheets");
  app.add_option("--pattern", options.pattern, "landing, shapes, or a picture");
  app.add_option("--dump", options.dump, "Folder for the pictures");
  app.add_option("--openings", options.openings, "Windows and doors in as many rooms, of houses that are")
      ->check(CLI::IsMember({"written", "held-back"}));
  app.add_option("--houses", options.houses, "A house of known shape in as many yards, of a generator that is")
      ->check(CLI::IsMember({"written", "held-back"}));
  app.add_flag("--tracked", options.tracked, "Openings as confirmed by looks from several places");
  app.add_flag("--verbose", options.verbose, "Name each opening that is missed or false");
  app.add_option("--only", options.only, "The recognizer whose name contains this");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!options.houses.empty()) {
      const auto houses =
          options.houses == "written" ? perception::KnownHouses::kWritten : perception::KnownHouses::kHeldBack;
      benchmarks::countHouses({houses, options.seed, options.first, options.pictures});
      return 0;
    }
    if (options.openings.empty()) return run(options);
    const auto houses = options.openings == "written" ? perception::Houses::kWritten : perception::Houses::kHeldBack;
    const benchmarks::OpeningRun rooms{houses, options.seed, options.first, options.pictures, options.verbose};
    if (options.tracked)
      benchmarks::followOpenings(rooms);
    else
      benchmarks::countOpenings(rooms);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
