// Least squares for numbers of the robot table and for others that are found beside them, each with what was known of
// it before as one more measurement. All corrections are in units of the standard deviation known before.
//
// Sources: what measurements cannot tell apart, by the singular values of the regressor, Gautier 1991 (doi
// 10.1002/rob.4620080405).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "host/drives/calibration/table_fields.hpp"

namespace liana::calibration {

inline Eigen::Index eigen_index(std::size_t i) { return static_cast<Eigen::Index>(i); }

// What a fit says of fields.
struct FieldsFound {
  std::vector<FieldValue> values;
  // Fields that the poses cannot tell apart: of each direction in which the readings say less than was known before,
  // those that take part in it.
  std::vector<std::vector<std::string>> not_told_apart;
  std::vector<std::string> problems;  // values beyond what is plausible: field, value, what is allowed, what to do
};

// Normal equations at one value of the corrections.
class PriorFit {
 public:
  // `count` corrections, those of the fields first.
  explicit PriorFit(std::size_t count);

  // Equations left + rows * change = 0, each in units of its noise.
  void add(const Eigen::MatrixXd& rows, const Eigen::VectorXd& left);

  // The change that fits best: one step of Gauss-Newton.
  Eigen::VectorXd step(const Eigen::VectorXd& value) const;
  // By how much more than their noise the equations scatter, at least 1.
  double scatter(std::size_t fields) const;
  FieldsFound found(const std::vector<TableField>& fields, const Eigen::VectorXd& value) const;

 private:
  Eigen::MatrixXd with_prior() const;

  Eigen::MatrixXd normal_;
  Eigen::VectorXd right_;
  double chi2_ = 0.0;
  double count_ = 0.0;
};

}  // namespace liana::calibration
