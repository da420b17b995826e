#include "perception/localization/particle_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/check.hpp"
#include "common/config_fields.hpp"
#include "common/resampling.hpp"
#include "common/small_matrices.hpp"
#include "common/validation.hpp"
#include "perception/localization/beam_sums.hpp"
#include "perception/localization/evenly_spread.hpp"
#include "perception/localization/kld_sampling.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose2;

constexpr float kPi = std::numbers::pi_v<float>;
/// Least number of particles, however narrow the belief is; at most max_particles.
constexpr int kMinParticles = 500;

/// Approximately standard normal, always within 3.5: the sum of four uniform numbers. Probabilistic Robotics, Table
/// 5.4, sums twelve.
float noise(common::RandomStream& random) {
  const std::uint64_t bits = random.bits();
  const auto sum = static_cast<float>((bits & 0xffff) + (bits >> 16 & 0xffff) + (bits >> 32 & 0xffff) + (bits >> 48));
  constexpr float kMean = 4.0F * 32767.5F;
  constexpr float kDeviation = 37837.2F;  // 65536 sqrt(4 / 12).
  return (sum - kMean) * (1.0F / kDeviation);
}

/// A matrix L with L L^T = covariance. The covariance may be singular.
Eigen::Matrix3f rootOf(const Eigen::Matrix3d& covariance) {
  const common::SymmetricEigen<3> eigen = common::symmetricEigen(covariance);
  return (eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal()).cast<float>();
}

}  // namespace

void ParticleFilterConfig::describe(common::config::Fields& fields) {
  fields("max_particles", max_particles, {10, 1'000'000}, "Greatest number of particles (5,000: Grzonka 2009, VI-A).");
}

std::vector<common::Problem> ParticleFilterConfig::validate() const {
  return common::Validation().atMost("min_particles", kMinParticles, "max_particles", max_particles).problems();
}

void cosinesAndSines(std::span<const float> angles_rad, std::span<float> cosines, std::span<float> sines) {
  constexpr float kQuarterHigh = 1.5707963705062866F, kQuarterLow = -4.371139000186241e-8F;  // pi / 2 in two parts.
  for (std::size_t i = 0; i < angles_rad.size(); ++i) {
    const float angle = angles_rad[i];
    const auto quarter = static_cast<std::int32_t>(angle * (2.0F / kPi) + (angle < 0.0F ? -0.5F : 0.5F));
    const auto turns = static_cast<float>(quarter);
    const float r = (angle - turns * kQuarterHigh) - turns * kQuarterLow, r2 = r * r;
    const float sine = r + r * r2 * (-1.6666654611e-1F + r2 * (8.3321608736e-3F - r2 * 1.9515295891e-4F));
    const float cosine = 1.0F - 0.5F * r2 +
                         r2 * r2 * (4.166664568298827e-2F + r2 * (-1.388731625493765e-3F + r2 * 2.443315711809948e-5F));
    const bool swap = (quarter & 1) != 0;
    const float c = swap ? sine : cosine, s = swap ? cosine : sine;
    cosines[i] = ((quarter + 1) & 2) != 0 ? -c : c;
    sines[i] = (quarter & 2) != 0 ? -s : s;
  }
}

ParticleFilter::ParticleFilter(std::shared_ptr<const MapField> map, const ParticleFilterConfig& config,
                               std::uint64_t seed, Instructions instructions)
    : map_(std::move(map)), config_(config), seed_(seed), instructions_(instructions) {}

void ParticleFilter::resize(std::size_t count) {
  for (std::vector<float>* values : {&x_m_, &y_m_, &yaw_rad_, &cosine_, &sine_}) values->resize(count);
  weights_.assign(count, 1.0F / static_cast<float>(count));
}

void ParticleFilter::wrapAndTurn() {
  for (float& yaw : yaw_rad_) yaw = yaw > kPi ? yaw - 2.0F * kPi : yaw <= -kPi ? yaw + 2.0F * kPi : yaw;
  cosinesAndSines(yaw_rad_, cosine_, sine_);
}

void ParticleFilter::spreadOverFreeSpace() {
  SWIFTLET_CHECK(map_->freeCells() > 0);
  common::RandomStream random(seed_, "spread over free space", draws_++);
  resize(static_cast<std::size_t>(config_.max_particles));
  const double half_m = 0.5 * map_->resolution_m();
  for (std::size_t i = 0; i < size(); ++i) {
    const auto cell = static_cast<std::size_t>(random.uniform() * static_cast<double>(map_->freeCells()));
    const Eigen::Vector2f center_m = map_->freeCell_m(cell).cast<float>();
    x_m_[i] = center_m.x() + static_cast<float>(random.uniform(-half_m, half_m));
    y_m_[i] = center_m.y() + static_cast<float>(random.uniform(-half_m, half_m));
    yaw_rad_[i] = static_cast<float>(random.uniform(-1.0, 1.0)) * kPi;
  }
  wrapAndTurn();
}

void ParticleFilter::spreadAround(std::span<const PoseHypothesis> hypotheses) {
  SWIFTLET_CHECK(!hypotheses.empty());
  common::RandomStream random(seed_, "spread around", draws_++);
  resize(static_cast<std::size_t>(config_.max_particles));
  double all = 0.0;
  for (const PoseHypothesis& h : hypotheses) all += h.probability;
  double until = 0.0;
  std::size_t i = 0;
  for (std::size_t k = 0; k < hypotheses.size(); ++k) {
    const PoseHypothesis& h = hypotheses[k];
    until += h.probability / all;
    const std::size_t end = k + 1 == hypotheses.size()
                                ? size()
                                : std::min(size(), static_cast<std::size_t>(until * static_cast<double>(size())));
    const Eigen::Matrix3f root = rootOf(h.covariance);
    for (; i < end; ++i) {
      const Eigen::Vector3f off = root * Eigen::Vector3f(noise(random), noise(random), noise(random));
      x_m_[i] = static_cast<float>(h.T_grid_body.x_m) + off.x();
      y_m_[i] = static_cast<float>(h.T_grid_body.y_m) + off.y();
      yaw_rad_[i] = static_cast<float>(common::wrapAngle(h.T_grid_body.yaw_rad + static_cast<double>(off.z())));
    }
  }
  wrapAndTurn();
}

void ParticleFilter::move(const Pose2& step, const Eigen::Matrix3d& covariance) {
  common::RandomStream random(seed_, "move", draws_++);
  const Eigen::Matrix3f root = rootOf(covariance);
  const auto step_x = static_cast<float>(step.x_m), step_y = static_cast<float>(step.y_m);
  const auto step_yaw = static_cast<float>(common::wrapAngle(step.yaw_rad));
  for (std::size_t i = 0; i < size(); ++i) {
    const float a = noise(random), b = noise(random), c = noise(random);
    const float forward = step_x + root(0, 0) * a + root(0, 1) * b + root(0, 2) * c;
    const float left = step_y + root(1, 0) * a + root(1, 1) * b + root(1, 2) * c;
    x_m_[i] += cosine_[i] * forward - sine_[i] * left;
    y_m_[i] += sine_[i] * forward + cosine_[i] * left;
    yaw_rad_[i] += step_yaw + root(2, 0) * a + root(2, 1) * b + root(2, 2) * c;
  }
  wrapAndTurn();
}

void ParticleFilter::weigh(std::span<const Eigen::Vector2f> points_body_m) {
  if (points_body_m.empty() || size() == 0) return;
  constexpr std::size_t kMostBeams = 60;  // Beams of a scan, evenly spread, that weigh the particles.
  const FieldView field = map_->view();
  const auto scale = static_cast<float>(1.0 / field.resolution_m);
  std::vector<float> beams_x(std::min(points_body_m.size(), kMostBeams)), beams_y(beams_x.size());
  for (std::size_t k = 0; k < beams_x.size(); ++k) {
    const Eigen::Vector2f& point = points_body_m[evenlySpread(k, beams_x.size(), points_body_m.size())];
    beams_x[k] = point.x() * scale;
    beams_y[k] = point.y() * scale;
  }
  std::vector<float> cells_x(size()), cells_y(size());
  std::vector<std::int32_t> sums(size());
  const auto origin_x = static_cast<float>(field.origin_m.x()), origin_y = static_cast<float>(field.origin_m.y());
  for (std::size_t i = 0; i < size(); ++i) {
    cells_x[i] = (x_m_[i] - origin_x) * scale;
    cells_y[i] = (y_m_[i] - origin_y) * scale;
  }
  sumBeams(instructions_, field, {cells_x, cells_y, cosine_, sine_}, {beams_x, beams_y}, sums);

  const std::int32_t best = *std::max_element(sums.begin(), sums.end());
  const auto nats = static_cast<float>(config_.beam_weight * map_->topNats() / 255.0);
  double all = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    weights_[i] *= std::exp(nats * static_cast<float>(sums[i] - best));
    all += static_cast<double>(weights_[i]);
  }
  // If every likely particle already had zero weight, nothing is known: all weights become equal.
  const bool vanished = !(all > 0.0);
  for (std::size_t i = 0; i < size(); ++i)
    weights_[i] = vanished ? 1.0F / static_cast<float>(size()) : static_cast<float>(weights_[i] / all);
}

void ParticleFilter::resample() {
  if (size() == 0) return;
  common::RandomStream random(seed_, "resample", draws_++);
  config_.adaptive ? resampleAdaptively(random) : resampleAll(random);
}

void ParticleFilter::resampleAll(common::RandomStream& random) {
  const auto count = static_cast<std::size_t>(config_.max_particles);
  const double all = std::accumulate(weights_.begin(), weights_.end(), 0.0);
  std::vector<std::uint32_t> chosen;
  common::drawSystematically(weights_, all, count, random.uniform(), chosen);
  keep(chosen);
}

/// Draws one by one until there are enough. The draws follow a golden-ratio sequence, so that any number of them is
/// spread as evenly over the weights as with the low-variance sampler.
void ParticleFilter::resampleAdaptively(common::RandomStream& random) {
  // Greatest distance between the belief and its samples, kept with a probability of 99 % (Fox 2003, section 4).
  constexpr double kError = 0.05, kQuantile = 2.33;
  // Width of the bins in which belief and samples are compared.
  constexpr double kBin_m = 0.25, kBin_deg = 10.0;
  std::vector<double> cumulated(size());
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) cumulated[i] = sum += static_cast<double>(weights_[i]);
  PoseBins bins(kBin_m, kBin_deg * kRadPerDeg);
  const auto most = static_cast<std::size_t>(config_.max_particles);
  double at = random.uniform(), enough = kMinParticles;
  std::size_t occupied = 0;
  std::vector<std::uint32_t> chosen;
  while (chosen.size() < most && static_cast<double>(chosen.size()) < enough) {
    const auto found = std::upper_bound(cumulated.begin(), cumulated.end(), at * sum);
    const auto i = static_cast<std::size_t>(std::min(found, cumulated.end() - 1) - cumulated.begin());
    chosen.push_back(static_cast<std::uint32_t>(i));
    at += std::numbers::phi - 1.0;
    if (at >= 1.0) at -= 1.0;
    bins.add(x_m_[i], y_m_[i], yaw_rad_[i]);
    if (bins.occupied() == occupied) continue;
    occupied = bins.occupied();
    enough = std::max<double>(kMinParticles, kldSampleSize(occupied, kError, kQuantile));
  }
  keep(chosen);
}

void ParticleFilter::keep(std::span<const std::uint32_t> chosen) {
  std::vector<float> kept(chosen.size());
  for (std::vector<float>* values : {&x_m_, &y_m_, &yaw_rad_, &cosine_, &sine_}) {
    for (std::size_t i = 0; i < chosen.size(); ++i) kept[i] = (*values)[chosen[i]];
    values->assign(kept.begin(), kept.end());
  }
  weights_.assign(chosen.size(), 1.0F / static_cast<float>(chosen.size()));
}

PoseHypothesis ParticleFilter::estimate() const {
  double all = 0.0, x = 0.0, y = 0.0, cosine = 0.0, sine = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const auto weight = static_cast<double>(weights_[i]);
    all += weight;
    x += weight * static_cast<double>(x_m_[i]);
    y += weight * static_cast<double>(y_m_[i]);
    cosine += weight * static_cast<double>(cosine_[i]);
    sine += weight * static_cast<double>(sine_[i]);
  }
  PoseHypothesis estimate;
  if (!(all > 0.0)) return estimate;
  estimate.T_grid_body = {x / all, y / all, std::atan2(sine, cosine)};
  for (std::size_t i = 0; i < size(); ++i) {
    const Eigen::Vector3d off(static_cast<double>(x_m_[i]) - estimate.T_grid_body.x_m,
                              static_cast<double>(y_m_[i]) - estimate.T_grid_body.y_m,
                              common::wrapAngle(static_cast<double>(yaw_rad_[i]) - estimate.T_grid_body.yaw_rad));
    estimate.covariance += static_cast<double>(weights_[i]) / all * off * off.transpose();
  }
  return estimate;
}

}  // namespace swiftlet::perception
