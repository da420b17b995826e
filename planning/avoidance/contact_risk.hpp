// The probability that the hull meets a person on a course: over everything that the person may do next, with a spread
// that grows with time and with the time out of sight (chance constraints on predicted people: Trautman and Krause,
// "Unfreezing the robot", 2010, without the coupling; a person need not yield).
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::planning {

/// A person who walks, in the level frame.
struct NearPerson {
  Eigen::Vector2d place_m;  ///< Now; of one who is out of sight, predicted from the last sighting.
  Eigen::Vector2d velocity_m_s;
  double radius_m;
  double unseen_s;  ///< Since the last sighting.
};

/// Made for one scan.
class ContactRisk {
 public:
  /// Courses are predicted for 3 s: a person at 1.4 m/s, the preferred walking speed [Browning 2006], walks 4.2 m, and
  /// the vehicle needs 2 s to leave the width of hull and person at 1 m/s^2.
  static constexpr double kStep_s = 0.1;
  static constexpr int kSteps = 30;
  /// Places of the vehicle at every step, in the level frame.
  using Course = std::array<Eigen::Vector2d, kSteps + 1>;

  ContactRisk(double hull_radius_m, std::span<const NearPerson> people);

  bool anybody() const { return !people_.empty(); }
  /// In [0, 1]: that anybody is met.
  double of(const Course& course) const;
  /// Of the person with that index.
  double of(const Course& course, std::size_t person) const;

 private:
  struct Walk {
    double weight;
    std::array<Eigen::Vector2d, kSteps + 1> places_m;
  };
  struct Person {
    double reach_m;  ///< Hull and person.
    std::array<double, kSteps + 1> sigma_m;
    std::array<double, kSteps + 1> counts;  ///< Share of a contact at that time that counts.
    std::vector<Walk> walks;
  };

  double of(const Course& course, const Person& person) const;

  std::vector<Person> people_;
};

}  // namespace swiftlet::planning
