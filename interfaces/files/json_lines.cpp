#include "interfaces/files/json_lines.hpp"

#include <nlohmann/json.hpp>

#include "common/rounding.hpp"

namespace swiftlet::interfaces {

using nlohmann::ordered_json;

std::string toJson(const common::Event& event) {
  constexpr int kNanoseconds = 9;
  ordered_json object = {{"t_s", common::rounded(event.stamp.seconds(), kNanoseconds)},
                         {"severity", common::toString(event.severity)},
                         {"source", event.source},
                         {"text", event.text},
                         {"reason", event.reason}};
  if (const auto alarm = common::alarmOf(event); !alarm.empty()) object["alarm"] = alarm;
  if (!event.vehicle.empty()) object["vehicle"] = event.vehicle;
  return object.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

tl::expected<EventWriter, FileError> EventWriter::create(const std::filesystem::path& file) {
  return AppendFile::create(file).map([](AppendFile opened) { return EventWriter(std::move(opened)); });
}

Written EventWriter::write(const common::Event& event) { return file_.append(toJson(event) + "\n"); }

}  // namespace swiftlet::interfaces
