#include "interfaces/files/json_lines.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "common/read_bytes.hpp"
#include "common/rounding.hpp"

namespace swiftlet::interfaces {
namespace {

using nlohmann::ordered_json;

common::Event eventOf(const ordered_json& object) {
  common::Event event;
  const double t_s = object.at("t_s").get<double>();
  if (!(std::abs(t_s) <= common::kFarthestStamp_s))
    throw std::invalid_argument(fmt::format("t_s {} is no time of a flight", t_s));
  event.stamp = common::Time::fromSeconds(t_s);
  const std::string severity = object.at("severity").get<std::string>();
  bool known = false;
  for (const common::Severity s : {common::Severity::kInfo, common::Severity::kWarning, common::Severity::kError}) {
    if (severity != common::toString(s)) continue;
    event.severity = s;
    known = true;
  }
  if (!known) throw std::invalid_argument(fmt::format("unknown severity `{}`", severity));
  event.source = object.at("source").get<std::string>();
  event.text = object.at("text").get<std::string>();
  event.reason = object.value("reason", "");
  event.vehicle = object.value("vehicle", "");
  return event;
}

}  // namespace

std::string toJson(const common::Event& event) {
  constexpr int kNanoseconds = 9;
  ordered_json object = {{"t_s", common::rounded(event.stamp.seconds(), kNanoseconds)},
                         {"severity", common::toString(event.severity)},
                         {"source", event.source},
                         {"text", event.text},
                         {"reason", event.reason}};
  if (!event.vehicle.empty()) object["vehicle"] = event.vehicle;
  return object.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

tl::expected<EventWriter, FileError> EventWriter::create(const std::filesystem::path& file) {
  return AppendFile::create(file).map([](AppendFile opened) { return EventWriter(std::move(opened)); });
}

Written EventWriter::write(const common::Event& event) { return file_.append(toJson(event) + "\n"); }

std::vector<common::Event> readEvents(const std::filesystem::path& file) {
  const std::string bytes = common::readBytes(file);
  std::vector<common::Event> events;
  int line_number = 0;
  for (std::size_t begin = 0, end = 0; (end = bytes.find('\n', begin)) != std::string::npos; begin = end + 1) {
    ++line_number;
    const std::string line = bytes.substr(begin, end - begin);
    try {
      events.push_back(eventOf(ordered_json::parse(line)));
    } catch (const std::exception& e) {
      throw common::InputError(common::Problem{{file.string(), line_number}, "event", e.what(), ""});
    }
  }
  return events;
}

}  // namespace swiftlet::interfaces
