#include "perception/fusion/filter_tape.hpp"

#include <charconv>

#include <fmt/format.h>

namespace swiftlet::perception {
namespace {

using common::Time;

struct Tell {
  using Result = tl::expected<Insertion, std::string>;

  ErrorStateFilter& filter;
  Result operator()(const common::ImuSample& sample) const {
    filter.predict(sample);
    return Insertion::kTaken;
  }
  Result operator()(const TapedStart& start) const {
    return filter.initialize(start.height_m).map([] { return Insertion::kTaken; });
  }
  Result operator()(const TapedRest& rest) const {
    filter.setAtRest(rest.at_rest);
    return Insertion::kTaken;
  }
  Result operator()(const TapedPredicted& p) const {
    filter.setPredicted(p.predicted);
    return Insertion::kTaken;
  }
  Result operator()(const Measurement& m) const { return filter.add(m); }
};

std::string lineOfPose(const Measurement& m) {
  const Eigen::Vector3d along = m.unobservable_motion ? m.unobservable_motion->change : Eigen::Vector3d::Zero();
  const double lever_m = m.unobservable_motion ? m.unobservable_motion->lever_m : 0.0;
  const Eigen::Matrix3d& c = m.covariance;
  return fmt::format("pose {} {} {} {} {} {} {} {} {} {} {} {:d} {} {} {} {}\n", m.from.nanoseconds(),
                     m.stamp.nanoseconds(), m.pose.x_m, m.pose.y_m, m.pose.yaw_rad, c(0, 0), c(0, 1), c(0, 2), c(1, 1),
                     c(1, 2), c(2, 2), m.unobservable_motion.has_value(), along.x(), along.y(), along.z(), lever_m);
}

std::string lineOfVertical(const Measurement& m) {
  const Eigen::Vector3d& v = m.vertical;
  const Eigen::Matrix3d& c = m.covariance;
  return fmt::format("vertical {} {} {} {} {} {} {} {} {} {}\n", m.stamp.nanoseconds(), v.x(), v.y(), v.z(), c(0, 0),
                     c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2));
}

std::string lineOfPose3(const Measurement& m) {
  const Eigen::Quaterniond& q = m.pose3.rotation;
  const Eigen::Vector3d& p = m.pose3.position_m;
  std::string line = fmt::format("pose3 {} {} {} {} {} {} {} {} {}", m.from.nanoseconds(), m.stamp.nanoseconds(), q.w(),
                                 q.x(), q.y(), q.z(), p.x(), p.y(), p.z());
  for (int row = 0; row < 6; ++row)
    for (int column = row; column < 6; ++column) line += fmt::format(" {}", m.covariance6(row, column));
  return line + "\n";
}

struct Print {
  std::string operator()(const common::ImuSample& s) const {
    const auto &w = s.angular_velocity_body_rad_s, &f = s.specific_force_body_m_s2;
    const auto& q = s.rotation_ahrs_body;
    return fmt::format("imu {} {} {} {} {} {} {} {} {} {} {} {}\n", s.stamps.measured.nanoseconds(),
                       s.stamps.arrived.nanoseconds(), w.x(), w.y(), w.z(), f.x(), f.y(), f.z(), q.w(), q.x(), q.y(),
                       q.z());
  }
  std::string operator()(const TapedStart& s) const { return fmt::format("start {}\n", s.height_m); }
  std::string operator()(const TapedRest& r) const { return fmt::format("rest {:d}\n", r.at_rest); }
  std::string operator()(const TapedPredicted& p) const { return fmt::format("predicted {:d}\n", p.predicted); }
  std::string operator()(const Measurement& m) const {
    const std::int64_t time = m.stamp.nanoseconds();
    switch (m.kind) {
      case MeasurementKind::kHeight:
        return fmt::format("height {} {} {}\n", time, m.value, m.covariance(0, 0));
      case MeasurementKind::kVertical:
        return lineOfVertical(m);
      case MeasurementKind::kRelativePose:
        return lineOfPose(m);
      case MeasurementKind::kRelativePose3:
        return lineOfPose3(m);
      case MeasurementKind::kClone:
        return fmt::format("{} {}\n", m.source == OdometrySource::kLaser ? "clone" : "clone3", time);
      case MeasurementKind::kAbsolutePose:
        break;  // No flight measures one.
    }
    return "";
  }
};

/// The words behind the first, as numbers.
class Numbers {
 public:
  explicit Numbers(const std::vector<std::string_view>& words) : words_(words) {}
  bool are(std::size_t count) const { return words_.size() == count + 1; }
  double number() { return parsed<double>(); }
  Time time() { return Time::fromNanoseconds(parsed<std::int64_t>()); }
  bool good() const { return good_; }

 private:
  template <typename Value>
  Value parsed() {
    const std::string_view word = words_[next_++];
    Value value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    good_ = good_ && error == std::errc() && end == word.data() + word.size();
    return value;
  }
  const std::vector<std::string_view>& words_;
  std::size_t next_ = 1;
  bool good_ = true;
};

common::ImuSample imuOf(Numbers& n) {
  common::ImuSample sample;
  sample.stamps.measured = n.time();
  sample.stamps.arrived = n.time();
  for (int i = 0; i < 3; ++i) sample.angular_velocity_body_rad_s[i] = n.number();
  for (int i = 0; i < 3; ++i) sample.specific_force_body_m_s2[i] = n.number();
  const double w = n.number(), x = n.number(), y = n.number(), z = n.number();
  sample.rotation_ahrs_body = Eigen::Quaterniond(w, x, y, z);
  return sample;
}

Eigen::Matrix3d covarianceOf(Numbers& n) {
  Eigen::Matrix3d covariance;
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column) covariance(row, column) = covariance(column, row) = n.number();
  return covariance;
}

Measurement verticalOf(Numbers& n) {
  const Time time = n.time();
  VerticalState state;
  state.height_m = n.number();
  state.velocity_m_s = n.number();
  state.bias_m_s2 = n.number();
  state.covariance = covarianceOf(n);
  return knownVertical(time, state);
}

Measurement poseOf(Numbers& n) {
  const Time from = n.time(), to = n.time();
  common::Pose2 T_from_to;
  T_from_to.x_m = n.number();
  T_from_to.y_m = n.number();
  T_from_to.yaw_rad = n.number();
  const Eigen::Matrix3d covariance = covarianceOf(n);
  const bool unobservable = n.number() != 0.0;
  common::UnobservableMotion motion;
  for (int i = 0; i < 3; ++i) motion.change(i) = n.number();
  motion.lever_m = n.number();
  return measuredRelativePose(from, to, T_from_to, covariance, unobservable ? std::optional(motion) : std::nullopt);
}

Measurement pose3Of(Numbers& n) {
  const Time from = n.time(), to = n.time();
  const double w = n.number(), x = n.number(), y = n.number(), z = n.number();
  common::Pose3 T_from_to{Eigen::Quaterniond(w, x, y, z), Eigen::Vector3d::Zero()};
  for (int i = 0; i < 3; ++i) T_from_to.position_m[i] = n.number();
  Eigen::Matrix<double, 6, 6> covariance;
  for (int row = 0; row < 6; ++row)
    for (int column = row; column < 6; ++column) covariance(row, column) = covariance(column, row) = n.number();
  return measuredRelativePose3(from, to, T_from_to, covariance);
}

/// One of the shorter inputs.
FilterInput shortOf(std::string_view name, Numbers& n) {
  if (name == "start") return TapedStart{n.number()};
  if (name == "rest") return TapedRest{n.number() != 0.0};
  if (name == "predicted") return TapedPredicted{n.number() != 0.0};
  if (name == "clone") return poseClone(n.time(), OdometrySource::kLaser);
  if (name == "clone3") return poseClone(n.time(), OdometrySource::kVision);
  const Time time = n.time();
  const double value = n.number();
  return measuredHeight(time, value, n.number());
}

}  // namespace

tl::expected<Insertion, std::string> tell(ErrorStateFilter& filter, const FilterInput& input) {
  return std::visit(Tell{filter}, input);
}

std::string toLine(const FilterInput& input) { return std::visit(Print{}, input); }

std::optional<FilterInput> filterInputOf(const std::vector<std::string_view>& words) {
  struct Form {
    std::string_view name;
    std::size_t numbers;
  };
  constexpr Form kForms[] = {{"imu", 12},   {"start", 1}, {"rest", 1},   {"predicted", 1}, {"clone", 1},
                             {"clone3", 1}, {"pose", 16}, {"pose3", 30}, {"height", 3},    {"vertical", 10}};
  if (words.empty()) return std::nullopt;
  Numbers numbers(words);
  for (const Form& form : kForms) {
    if (words[0] != form.name || !numbers.are(form.numbers)) continue;
    FilterInput input = form.name == "imu"        ? FilterInput(imuOf(numbers))
                        : form.name == "pose"     ? FilterInput(poseOf(numbers))
                        : form.name == "pose3"    ? FilterInput(pose3Of(numbers))
                        : form.name == "vertical" ? FilterInput(verticalOf(numbers))
                                                  : shortOf(form.name, numbers);
    if (numbers.good()) return input;
  }
  return std::nullopt;
}

}  // namespace swiftlet::perception
