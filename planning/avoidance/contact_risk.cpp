#include "planning/avoidance/contact_risk.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "common/possible_walks.hpp"

namespace swiftlet::planning {
namespace {

/// Standard deviations of a tracked person: of the place, and of the velocity (as in perception/people/hidden_person).
constexpr double kPlaceSigma_m = 0.1, kVelocitySigma_m_s = 0.15;
/// A walking person turns this often, per second, and then in any direction (as in perception/people/hidden_person).
constexpr double kTurns_1_s = 0.4;
constexpr int kTurnDirections = 8;
/// What comes later can still be decided again at later scans: after this time a contact counts half.
constexpr double kDecided_s = 1.5;
/// Beyond, the probability is below 1e-4.
constexpr double kNever = 5.0;

/// The logistic approximation of the normal distribution, within 0.01 [Bowling 2009].
double below(double z) { return z > kNever ? 0.0 : 1.0 / (1.0 + std::exp(1.702 * z)); }

/// What a person may do from now on. Who is out of sight goes on as before with the probability of no turn since, and
/// has turned somewhere otherwise, on average half of the time ago.
std::vector<common::PossibleWalk> walksOf(const NearPerson& near) {
  const double straight = std::exp(-kTurns_1_s * near.unseen_s);
  std::vector<common::PossibleWalk> walks = common::possibleWalks(near.place_m, near.velocity_m_s);
  for (common::PossibleWalk& walk : walks) walk.weight *= straight;
  const double since_s = 0.5 * near.unseen_s;
  for (int i = 0; i < kTurnDirections && since_s > 0.0; ++i) {
    const Eigen::Rotation2Dd turn(2.0 * std::numbers::pi * i / kTurnDirections);
    const Eigen::Vector2d velocity_m_s = turn * near.velocity_m_s;
    walks.push_back({near.place_m + since_s * (velocity_m_s - near.velocity_m_s), velocity_m_s,
                     (1.0 - straight) / kTurnDirections});
  }
  return walks;
}

}  // namespace

ContactRisk::ContactRisk(double hull_radius_m, std::span<const NearPerson> people) {
  for (const NearPerson& near : people) {
    Person person;
    person.reach_m = hull_radius_m + near.radius_m;
    for (int i = 0; i <= kSteps; ++i) {
      const double time_s = i * kStep_s, grown_m = kVelocitySigma_m_s * (time_s + near.unseen_s);
      const auto at = static_cast<std::size_t>(i);
      const double variance_m2 = kPlaceSigma_m * kPlaceSigma_m + grown_m * grown_m;
      person.sigma_m[at] = std::sqrt(variance_m2);
      // Of a spread wider than hull and person only a part can be met.
      const double met = std::min(1.0, 0.5 * person.reach_m * person.reach_m / variance_m2);
      person.counts[at] = met / (1.0 + time_s / kDecided_s);
    }
    for (const common::PossibleWalk& possible : walksOf(near)) {
      Walk& walk = person.walks.emplace_back();
      walk.weight = possible.weight;
      for (int i = 0; i <= kSteps; ++i)
        walk.places_m[static_cast<std::size_t>(i)] = possible.place_map_m + i * kStep_s * possible.velocity_map_m_s;
    }
    people_.push_back(std::move(person));
  }
}

double ContactRisk::of(const Course& course) const {
  double none = 1.0;
  for (const Person& person : people_) none *= 1.0 - of(course, person);
  return 1.0 - none;
}

double ContactRisk::of(const Course& course, std::size_t person) const { return of(course, people_.at(person)); }

double ContactRisk::of(const Course& course, const Person& person) const {
  double sum = 0.0;
  for (const Walk& walk : person.walks) {
    double most = 0.0;
    for (std::size_t i = 0; i < course.size(); ++i) {
      if (person.counts[i] <= most) continue;
      const double gap_m = (walk.places_m[i] - course[i]).norm() - person.reach_m;
      most = std::max(most, person.counts[i] * below(gap_m / person.sigma_m[i]));
    }
    sum += walk.weight * most;
  }
  return sum;
}

}  // namespace swiftlet::planning
