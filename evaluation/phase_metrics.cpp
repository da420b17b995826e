#include "evaluation/phase_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/error.hpp"
#include "common/validation.hpp"
#include "common/world.hpp"
#include "common/world/map_layer.hpp"
#include "evaluation/phase_words.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::evaluation {

using common::Message;
using common::Problem;
using common::Time;

namespace {

/// Ticks of 10 ms; an estimate older than they are is stale, not wrong.
constexpr std::size_t kTruths = 10;

/// "level_1_height_m".
bool isHeightOfALevel(std::string_view figure) {
  constexpr std::string_view kBegin = "level_", kEnd = "_height_m";
  if (figure.size() <= kBegin.size() + kEnd.size() || !figure.starts_with(kBegin) || !figure.ends_with(kEnd))
    return false;
  figure.remove_prefix(kBegin.size());
  figure.remove_suffix(kEnd.size());
  return figure.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

void PhaseBound::describe(common::config::Fields& fields) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  fields("figure", figure, "Name of the phase's figure, as in the results: position_std_m, level_1_height_m.");
  fields("min", min, {-kInfinity, kInfinity}, "Least value.");
  fields("max", max, {-kInfinity, kInfinity}, "Greatest value.");
}

std::vector<common::Problem> PhaseBound::validate() const {
  return common::Validation()
      .given(!figure.empty(), "figure")
      .require(std::isfinite(min) || std::isfinite(max), "max", Message("phase.no-bound", "is missing, and so is min"))
      .atMost("min", min, "max", max)
      .problems();
}

void PhaseConfig::describe(common::config::Fields& fields) {
  fields("name", name, "Name of the phase in the results.");
  fields("from_s", from_s, {0, 1e6}, "Time of the flight before which nothing counts.");
  fields("to_s", to_s, {0, 1e6}, "Time of the flight from which nothing counts.");
  fields("phase", phase,
         "The phase counts only while the flight's state, the mission's phase or reason, or a running behaviour begins "
         "with this text: `flying`, `hold`, `GoHome`; empty for the whole flight.");
  fields("settle_s", settle_s, {0, 1e6}, "Time after each beginning of the phase that does not count.");
  fields("place_map_m", place_map_m, {-1e4, 1e4},
         "Place x, y in the vehicle's frame `map` from which the RMS of the position is taken; empty for no RMS.");
  fields("height_map_m", height_map_m, {0, 100},
         "Height over the take-off floor that the vehicle is to keep; height_error_max_m is the error of it. 0: none.");
  fields.list("criteria", criteria, "Bounds of the phase's figures.");
}

std::vector<common::Problem> PhaseConfig::validate() const {
  common::Validation validation;
  for (const PhaseBound& bound : criteria)
    if (!bound.figure.empty()) validation.refuse("criteria", phaseFigureProblem(*this, bound.figure));
  return validation.given(!name.empty(), "name")
      .require(place_map_m.empty() || place_map_m.size() == 2, "place_map_m",
               Message("config.no-place", "is not one place x, y"))
      .atMost("from_s", from_s, "to_s", to_s)
      .problems();
}

std::optional<double> PhaseScore::figure(const std::string& figure) const {
  for (const auto& [known, value] : figures)
    if (known == figure) return value;
  return std::nullopt;
}

std::string missed(const PhaseBound& bound, const std::optional<double>& value) {
  if (value && *value >= bound.min && *value <= bound.max) return {};
  const std::string asked = !std::isfinite(bound.min)   ? fmt::format("at most {:g}", bound.max)
                            : !std::isfinite(bound.max) ? fmt::format("at least {:g}", bound.min)
                                                        : fmt::format("{:g} to {:g}", bound.min, bound.max);
  return fmt::format("{}: {}, {} was asked for", bound.figure, value ? fmt::format("{:.4f}", *value) : "not measured",
                     asked);
}

std::vector<std::string> PhaseScore::missed() const {
  std::vector<std::string> failures;
  for (const PhaseBound& bound : criteria)
    if (const std::string failure = evaluation::missed(bound, figure(bound.figure)); !failure.empty())
      failures.push_back(fmt::format("phase {}: {}", name, failure));
  return failures;
}

/// The names come from a recorder that has seen one tick.
std::vector<std::string> phaseFigureNames(const PhaseConfig& config) {
  PhaseConfig any = config;
  any.from_s = any.settle_s = 0.0;
  PhaseRecorder recorder(std::move(any));
  PhaseTick tick;
  tick.reference_odom_m = Eigen::Vector3d::Zero();
  recorder.tickInPhase(tick);
  std::vector<std::string> names;
  for (const auto& [name, value] : recorder.finish().figures)
    if (!name.starts_with("level_")) names.push_back(name);
  return names;
}

std::optional<Problem> phaseFigureProblem(const PhaseConfig& config, const std::string& name) {
  PhaseConfig with_all = config;
  with_all.place_map_m = {0.0, 0.0};
  with_all.height_map_m = 1.0;
  const std::vector<std::string> names = phaseFigureNames(with_all);
  const bool known = std::find(names.begin(), names.end(), name) != names.end() || isHeightOfALevel(name);
  if (!known)
    return Problem{
        {}, "", Message("phase.no-figure", "`{}` is not a figure of a phase", name), common::didYouMean(name, names)};
  const bool needs_place = name == "position_rms_m" || name == "position_max_m" || name == "position_return_s";
  if (needs_place && config.place_map_m.empty())
    return Problem{{}, "", Message("phase.no-place", "`{}` needs a place_map_m", name), ""};
  if (name == "height_error_max_m" && config.height_map_m <= 0.0)
    return Problem{{}, "", Message("phase.no-height", "`{}` needs a height_map_m", name), ""};
  return std::nullopt;
}

void PhaseRecorder::world(const common::World& world) {
  in_phase_ = anyBeginsWith(phaseWords(world), config_.phase);
  if (!in_phase_) course_.since.reset();
  if (!course_.last || !course_.since || world.map->levels == nullptr) return;
  level_heights_m_.clear();
  for (const common::Level& level : world.map->levels->levels) level_heights_m_.push_back(level.height_m);
  std::sort(level_heights_m_.begin(), level_heights_m_.end());
}

void PhaseRecorder::tick(const PhaseTick& tick) {
  if (!in_phase_ || tick.now.seconds() < config_.from_s || tick.now.seconds() >= config_.to_s) {
    course_.since.reset();
    return;
  }
  if (!course_.since) {
    course_.since = tick.now;
    course_.last.reset();
    course_.yaw_begin_rad = common::yawOf(tick.T_map_truth.rotation);
  }
  follow(tick);
  if ((tick.now - *course_.since).seconds() < config_.settle_s) return;
  tickInPhase(tick);
}

/// From the first tick of the phase on: what does not count yet is the way back.
void PhaseRecorder::follow(const PhaseTick& tick) {
  const double time_s = (tick.now - *course_.since).seconds();
  const double yaw_off_rad = common::wrapAngle(common::yawOf(tick.T_map_truth.rotation) - course_.yaw_begin_rad);
  if (std::abs(yaw_off_rad) > Course::kReturned_rad) course_.yaw_last_off_s = std::max(course_.yaw_last_off_s, time_s);
  if (config_.place_map_m.empty()) return;
  const Eigen::Vector2d place_m(config_.place_map_m[0], config_.place_map_m[1]);
  if ((tick.T_map_truth.position_m.head<2>() - place_m).norm() > Course::kReturned_m)
    course_.place_last_off_s = std::max(course_.place_last_off_s, time_s);
}

void PhaseRecorder::tickInPhase(const PhaseTick& tick) {
  const Eigen::Vector3d& velocity_m_s = tick.velocity_map_m_s;
  if (course_.last) course_.time_s += (tick.now - *course_.last).seconds();
  course_.last = tick.now;
  series_.x_m.push_back(tick.T_map_truth.position_m.x());
  series_.y_m.push_back(tick.T_map_truth.position_m.y());
  series_.height_m.push_back(tick.T_map_truth.position_m.z());
  series_.speed_m_s.push_back(velocity_m_s.head<2>().norm());
  series_.speed_x_m_s.push_back(std::abs(velocity_m_s.x()));
  series_.speed_y_m_s.push_back(std::abs(velocity_m_s.y()));
  series_.yaw_rad.push_back(common::yawOf(tick.T_map_truth.rotation));
  const double yaw_off_rad = std::abs(common::wrapAngle(series_.yaw_rad.back() - course_.yaw_begin_rad));
  course_.yaw_off_max_rad = std::max(course_.yaw_off_max_rad, yaw_off_rad);
  if (tick.reference_odom_m)
    course_.control_error_max_m = std::max(course_.control_error_max_m.value_or(0.0),
                                           (*tick.reference_odom_m - tick.estimate.T_odom_body.position_m).norm());
  // An estimate is of the last inertial sample, some milliseconds before the tick.
  true_velocities_m_s_.emplace_back(tick.now, velocity_m_s);
  if (true_velocities_m_s_.size() > kTruths) true_velocities_m_s_.pop_front();
  if (const auto then_m_s = trueVelocityAt(tick.estimate.stamp))
    series_.velocity_error_m_s.push_back((tick.estimate.velocity_map_m_s() - *then_m_s).norm());
}

/// Interpolated; nothing outside of the last ticks.
std::optional<Eigen::Vector3d> PhaseRecorder::trueVelocityAt(Time time) const {
  const auto& truths = true_velocities_m_s_;
  if (truths.empty() || time < truths.front().first || time > truths.back().first) return std::nullopt;
  const auto after = std::find_if(truths.begin(), truths.end(), [&](const auto& truth) { return truth.first >= time; });
  if (after->first == time) return after->second;
  const auto before = std::prev(after);
  const double share = (time - before->first).seconds() / (after->first - before->first).seconds();
  return Eigen::Vector3d((1.0 - share) * before->second + share * after->second);
}

/// Yaw is unwrapped about its circular mean.
void PhaseRecorder::addPlaces(PhaseFigures& figures) const {
  const Statistics x = statisticsOf(series_.x_m), y = statisticsOf(series_.y_m),
                   speed = statisticsOf(series_.speed_m_s);
  const Statistics height = statisticsOf(series_.height_m), velocity_error = statisticsOf(series_.velocity_error_m_s);
  const Statistics along_x = statisticsOf(series_.speed_x_m_s), along_y = statisticsOf(series_.speed_y_m_s);
  double sine = 0.0, cosine = 0.0;
  for (const double yaw : series_.yaw_rad) sine += std::sin(yaw), cosine += std::cos(yaw);
  const double yaw_mean = std::atan2(sine, cosine);
  std::vector<double> yaw_off;
  for (const double yaw : series_.yaw_rad) yaw_off.push_back(common::wrapAngle(yaw - yaw_mean));
  const PhaseFigures all = {{"position_mean_x_m", x.mean},
                            {"position_mean_y_m", y.mean},
                            {"position_std_m", std::hypot(x.standard_deviation, y.standard_deviation)},
                            {"speed_mean_m_s", speed.mean},
                            {"speed_std_m_s", speed.standard_deviation},
                            {"speed_axis_mean_m_s", std::max(along_x.mean, along_y.mean)},
                            {"speed_axis_std_m_s", std::max(along_x.standard_deviation, along_y.standard_deviation)},
                            {"yaw_mean_rad", yaw_mean},
                            {"yaw_std_rad", statisticsOf(yaw_off).standard_deviation},
                            {"height_mean_m", height.mean},
                            {"height_std_m", height.standard_deviation},
                            {"velocity_error_mean_m_s", velocity_error.mean},
                            {"velocity_error_std_m_s", velocity_error.standard_deviation},
                            {"velocity_error_rms_m_s", velocity_error.rmse}};
  figures.insert(figures.end(), all.begin(), all.end());
  if (config_.place_map_m.empty()) return;
  std::vector<double> off_m;
  for (std::size_t i = 0; i < series_.x_m.size(); ++i)
    off_m.push_back(std::hypot(series_.x_m[i] - config_.place_map_m[0], series_.y_m[i] - config_.place_map_m[1]));
  figures.emplace_back("position_rms_m", statisticsOf(off_m).rmse);
  if (!off_m.empty()) figures.emplace_back("position_max_m", *std::max_element(off_m.begin(), off_m.end()));
}

/// Greatest errors, as papers give them, and how long the vehicle needed to come back.
void PhaseRecorder::addBounds(PhaseFigures& figures) const {
  figures.emplace_back("yaw_off_max_rad", course_.yaw_off_max_rad);
  figures.emplace_back("yaw_return_s", course_.yaw_last_off_s);
  if (!config_.place_map_m.empty()) figures.emplace_back("position_return_s", course_.place_last_off_s);
  if (course_.control_error_max_m) figures.emplace_back("control_error_max_m", *course_.control_error_max_m);
  if (config_.height_map_m <= 0.0) return;
  double error_max_m = 0.0;
  for (const double height_m : series_.height_m)
    error_max_m = std::max(error_max_m, std::abs(height_m - config_.height_map_m));
  figures.emplace_back("height_error_max_m", error_max_m);
}

void PhaseRecorder::addLevels(PhaseFigures& figures) const {
  figures.emplace_back("levels", static_cast<double>(level_heights_m_.size()));
  for (std::size_t i = 0; i < level_heights_m_.size(); ++i)
    figures.emplace_back(fmt::format("level_{}_height_m", i), level_heights_m_[i]);
}

PhaseScore PhaseRecorder::finish() const {
  PhaseScore score{config_.name, {{"time_s", course_.time_s}}, config_.criteria};
  if (series_.x_m.empty()) return score;
  addPlaces(score.figures);
  addBounds(score.figures);
  addLevels(score.figures);
  return score;
}

}  // namespace swiftlet::evaluation
