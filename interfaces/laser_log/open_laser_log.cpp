#include "interfaces/laser_log/open_laser_log.hpp"

#include <string>

#include "interfaces/laser_log/bag_log.hpp"
#include "interfaces/laser_log/bag_reader.hpp"
#include "interfaces/laser_log/breezy.hpp"
#include "interfaces/laser_log/carmen.hpp"
#include "interfaces/laser_log/text_log.hpp"

namespace swiftlet::interfaces {
namespace {

/// The format is recognized within these first lines and bytes.
constexpr int kFirstLines = 1000;
constexpr std::size_t kFirstBytes = 64;

enum class Format { kUnknown, kEmpty, kCarmen, kBreezy, kBag };

Format formatOf(const std::filesystem::path& file) {
  std::string first(kFirstBytes, '\0');
  first.resize(UnpackedStream(file).read(first.data(), first.size()).value_or(0));
  if (isBag(first)) return Format::kBag;
  LineReader reader(file, kLogLimits);
  std::string_view line;
  int lines = 0;
  for (; lines < kFirstLines && reader.next(line); ++lines) {
    if (isCarmenLine(line)) return Format::kCarmen;
    if (isBreezyLine(line)) return Format::kBreezy;
  }
  return lines == 0 ? Format::kEmpty : Format::kUnknown;
}

}  // namespace

std::unique_ptr<LaserLog> openLaserLog(const std::filesystem::path& file, const LaserLogOptions& options) {
  const Format format = formatOf(file);
  if (format == Format::kCarmen) return openTextLog(file, carmenFormat(file, options));
  if (format == Format::kBreezy) return openTextLog(file, breezyFormat(file, options));
  if (format == Format::kBag) return openBagLog(file, options);
  throw common::InputError({file.string(), 0, 0}, "",
                           format == Format::kEmpty
                               ? common::Message("laser-log.empty", "is empty")
                               : common::Message("laser-log.unknown-format", "not a laser log known here"),
                           "expected CARMEN text (FLASER or ROBOTLASER1 lines), BreezySLAM's .dat or a rosbag 1");
}

}  // namespace swiftlet::interfaces
