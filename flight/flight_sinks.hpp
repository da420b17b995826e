// The sinks of a flight: its run folder, the page, and a function that gets its events.
#pragma once

#include <functional>
#include <memory>

#include "autonomy/loop/flight_sink.hpp"

namespace swiftlet::interfaces {
class RunFolder;
}

namespace swiftlet::flight {

class WebChannel;

/// Each sink refers to its arguments, which must outlive it.
class FolderSink final : public autonomy::FlightSink {
 public:
  explicit FolderSink(interfaces::RunFolder& folder) : folder_(folder) {}
  void ticked(const autonomy::TickOutcome& outcome) override;
  void world(const std::shared_ptr<const common::World>& world) override;
  void file(const autonomy::RunFile& file) override;
  void event(const common::Event& event) override;

 private:
  interfaces::RunFolder& folder_;
};

class PageSink final : public autonomy::FlightSink {
 public:
  explicit PageSink(WebChannel& web) : web_(web) {}
  /// The newest camera frame.
  void input(const autonomy::Input& input) override;
  void world(const std::shared_ptr<const common::World>& world) override;
  void event(const common::Event& event) override;
  void result(const common::CommandResult& result) override;

 private:
  WebChannel& web_;
};

class EventSink final : public autonomy::FlightSink {
 public:
  using Report = std::function<void(const common::Event&)>;
  explicit EventSink(Report report) : report_(std::move(report)) {}
  void event(const common::Event& event) override { report_(event); }

 private:
  Report report_;
};

}  // namespace swiftlet::flight
