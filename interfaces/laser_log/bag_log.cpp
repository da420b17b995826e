#include "interfaces/laser_log/bag_log.hpp"

#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>

#include "interfaces/laser_log/bag_reader.hpp"
#include "interfaces/laser_log/counted_log.hpp"
#include "interfaces/laser_log/laser_scan_message.hpp"
#include "interfaces/laser_log/scan_geometry.hpp"

namespace swiftlet::interfaces {
namespace {

/// The most topics that a message lists.
constexpr std::size_t kTopicsListed = 5;

class BagLog final : public CountedLog {
 public:
  BagLog(const std::filesystem::path& file, const LaserLogOptions& options)
      : file_bytes_(static_cast<double>(std::filesystem::file_size(file))),
        options_(options),
        reader_(UnpackedStream(file), {isLaserScan, kMostScanBytes, [this](common::Message message) {
                                         skipped({{reader_.name()}, "", std::move(message), ""});
                                       }}) {}

  std::optional<LoggedScan> next() override {
    for (BagMessage message; reader_.next(message);) {
      const std::string& topic = message.connection->topic;
      if (topic_.empty()) topic_ = topic;
      if (topic != topic_) {
        ++others_[topic];
        continue;
      }
      ++messages_;
      if (auto scan = read(message)) return counted(std::move(*scan));
    }
    if (messages_ == 0) throw noScans();
    return std::nullopt;
  }

  double progress() const override {
    return file_bytes_ > 0.0 ? std::min(1.0, static_cast<double>(reader_.packedBytesRead()) / file_bytes_) : 1.0;
  }
  std::string format() const override { return topic_.empty() ? "rosbag" : "rosbag, " + shown(topic_); }

  std::vector<std::string> notes() const override {
    std::vector<std::string> notes;
    for (const auto& [topic, count] : others_)
      notes.push_back(fmt::format("{} scans of {} are left out, {} came first", count, shown(topic), shown(topic_)));
    return notes;
  }

 private:
  std::optional<LoggedScan> read(const BagMessage& message) {
    auto scan = parseLaserScan(message);
    if (scan) {
      const auto problem = completeScan(options_.sensor, *scan);
      if (!problem) return std::move(*scan);
      scan = tl::unexpected(RecordProblem{0, "", *problem});
    }
    skipped({{reader_.name()}, fmt::format("{}, message {}", shown(topic_), messages_), scan.error().message, ""});
    return std::nullopt;
  }

  static std::string layoutOf(const BagConnection& connection) {
    std::string layout = shown(connection.type);
    if (connection.type == kLaserScanType && !isLaserScan(connection))
      layout += fmt::format(" of another layout, md5 {}", shown(connection.md5sum));
    return layout;
  }

  common::InputError noScans() const {
    std::string topics;
    std::size_t listed = 0;
    for (const auto& [id, connection] : reader_.connections()) {
      if (listed++ == kTopicsListed) break;
      topics +=
          fmt::format("{}{} ({})", topics.empty() ? "it has " : ", ", shown(connection.topic), layoutOf(connection));
    }
    // The first problem explains why there are no scans.
    std::string why;
    for (const common::Problem& problem : counts().first_problems) why += problem.message.text() + "; ";
    return common::InputError({reader_.name()}, "",
                              common::Message("bag.no-scans", "has no messages of type {}", kLaserScanType),
                              why + topics);
  }

  double file_bytes_;
  LaserLogOptions options_;
  BagReader reader_;
  std::string topic_;
  std::uint64_t messages_ = 0;
  std::map<std::string, std::uint64_t> others_;
};

}  // namespace

std::unique_ptr<LaserLog> openBagLog(const std::filesystem::path& file, const LaserLogOptions& options) {
  return std::make_unique<BagLog>(file, options);
}

}  // namespace swiftlet::interfaces
