#include "host/drives/calibration/prior_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "host/drives/calibration/text.hpp"

namespace liana::calibration {
namespace {

constexpr double kTakesPart = 0.3;  // of a direction's length

}  // namespace

PriorFit::PriorFit(std::size_t count)
    : normal_(Eigen::MatrixXd::Zero(eigen_index(count), eigen_index(count))),
      right_(Eigen::VectorXd::Zero(eigen_index(count))) {}

void PriorFit::add(const Eigen::MatrixXd& rows, const Eigen::VectorXd& left) {
  normal_ += rows.transpose() * rows;
  right_ -= rows.transpose() * left;
  chi2_ += left.squaredNorm();
  count_ += static_cast<double>(left.size());
}

Eigen::MatrixXd PriorFit::with_prior() const {
  return normal_ + Eigen::MatrixXd::Identity(normal_.rows(), normal_.cols());
}

Eigen::VectorXd PriorFit::step(const Eigen::VectorXd& value) const {
  return Eigen::LDLT<Eigen::MatrixXd>(with_prior()).solve(right_ - value);
}

double PriorFit::scatter(std::size_t fields) const {
  return std::sqrt(std::max(1.0, chi2_ / std::max(1.0, count_ - static_cast<double>(fields))));
}

FieldsFound PriorFit::found(const std::vector<TableField>& fields, const Eigen::VectorXd& value) const {
  FieldsFound out;
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(normal_.rows(), normal_.cols());
  const Eigen::MatrixXd covariance = Eigen::LDLT<Eigen::MatrixXd>(with_prior()).solve(one);
  const double scale = scatter(fields.size());
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const TableField& field = fields[f];
    const Eigen::Index i = eigen_index(f);
    const double found = field.known_value + field.known_sd * value(i);
    out.values.push_back({field.field, found, field.known_sd * std::min(1.0, scale * std::sqrt(covariance(i, i)))});
    if (std::fabs(found - field.table_value) > field.room())
      out.problems.push_back(
          field.field + text(": %.4g was found, the table has %.4g: allowed %.4g around it: measure it and correct "
                             "the table, or see whether something rests on the arm",
                             found, field.table_value, field.room()));
  }
  // What remains of the fields where all the rest may be anything; below 1 the readings say less than was known.
  const auto F = eigen_index(fields.size()), rest = normal_.rows() - F;
  const Eigen::MatrixXd cross = normal_.topRightCorner(F, rest);
  const Eigen::MatrixXd own =
      normal_.topLeftCorner(F, F) -
      cross * Eigen::LDLT<Eigen::MatrixXd>(with_prior().bottomRightCorner(rest, rest)).solve(cross.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(own);
  for (Eigen::Index d = 0; d < F; ++d) {
    if (directions.eigenvalues()(d) >= scale * scale) continue;
    std::vector<std::string> names;
    for (std::size_t f = 0; f < fields.size(); ++f) {
      if (std::fabs(directions.eigenvectors()(eigen_index(f), d)) > kTakesPart) names.push_back(fields[f].field);
    }
    out.not_told_apart.push_back(names);
  }
  return out;
}

}  // namespace liana::calibration
