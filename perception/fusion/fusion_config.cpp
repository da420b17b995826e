#include "perception/fusion/fusion_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::perception {

using common::config::kPositive;

void FusionConfig::describe(common::config::Fields& fields) {
  fields.choice("odometry_choice", odometry_choice, {"all", "best"},
                "Which relative poses are used: all of laser and camera, or those of the sensor with the smallest "
                "covariance alone.");
  fields("accelerometer_noise_m_s2_rthz", accelerometer_noise_m_s2_rthz, kPositive,
         "Least noise density of the accelerometer; what the samples show counts where it is more.");
  fields("gyroscope_noise_rad_s_rthz", gyroscope_noise_rad_s_rthz, kPositive, "Noise density of the gyroscope.");
  fields("accelerometer_bias_walk_m_s3_rthz", accelerometer_bias_walk_m_s3_rthz, kPositive,
         "Random walk of the accelerometer's bias.");
  fields("gyroscope_bias_walk_rad_s2_rthz", gyroscope_bias_walk_rad_s2_rthz, kPositive,
         "Random walk of the gyroscope's bias.");
  fields("use_ahrs", use_ahrs,
         "Whether roll and pitch of the vehicle's own AHRS are measurements. With false it may be missing: the filter "
         "starts by gravity.");
  fields("ahrs_sigma_deg", ahrs_sigma_deg, {0.01, 30}, "Standard deviation of the AHRS's roll and pitch.");
  fields(
      "use_gravity", use_gravity,
      "Whether the specific force is taken for gravity, for vehicles without an AHRS; then it is not taken for drag.");
  fields("drag_1_s", drag_1_s, {0.0, 10},
         "Deceleration per speed through the air at the start, 0.1 to 0.5 for small quadrotors; learned in flight.");
  fields("drag_noise_m_s2_rthz", drag_noise_m_s2_rthz, kPositive, "Noise density of the force that is taken for drag.");
}

}  // namespace swiftlet::perception
