// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// The two decompositions that a basis of lights needs, for matrices of some hundred rows and
/// columns. They use nothing but + - * / and square roots, so they give the same bits everywhere.
namespace abbe::optics {

/// Rows of numbers; all zero at first.
class Matrix {
public:
  Matrix(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), values_(rows * columns) {}
  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  std::span<double> row(std::size_t r) { return {values_.data() + r * columns_, columns_}; }
  std::span<double const> row(std::size_t r) const {
    return {values_.data() + r * columns_, columns_};
  }
  /// Gives up the rows from `count` on.
  void keep_rows(std::size_t count) {
    rows_ = count;
    values_.resize(count * columns_);
  }

private:
  std::size_t rows_, columns_;
  std::vector<double> values_;
};

double dot(std::span<double const> a, std::span<double const> b);
double length(std::span<double const> a);
/// a += factor * b
void add(std::span<double> a, double factor, std::span<double const> b);

/// Turns `m` into its R of a QR decomposition with column pivoting (Householder). Only the first
/// `pivots` columns are chosen from; the others are turned along, so they hold Q^T times what they
/// held. It ends early when what is left of the columns is shorter than `least`.
/// @return which column was chosen in each step; the columns themselves stay where they are
/// @source G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., algorithm 5.4.1
std::vector<std::size_t> decompose_qr(Matrix& m, std::size_t pivots, double least);

/// The right singular vectors of `m` as rows, strongest first; those whose singular value is not
/// above `least` are left out.
/// @source one-sided Jacobi rotations after a pivoted QR decomposition: Z. Drmac, K. Veselic, New
///         fast and accurate Jacobi SVD algorithm I, SIAM J. Matrix Anal. Appl. 29 (2008)
Matrix right_singular_vectors(Matrix m, double least);

} // namespace abbe::optics
