// SPDX-License-Identifier: GPL-3.0-or-later
#include "maths/LinearSolve.H"

#include <Eigen/Cholesky>

namespace shizuku
{

bool solveSymmetric(int n, const double* a, const double* b, double* x)
{
    constexpr double smallestPivot = 1e-13;     // of the diagonal it came from; rounding leaves about 1e-16 n
    const Eigen::Map<const Eigen::MatrixXd> matrix(a, n, n);
    const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
    const auto pivots = cholesky.matrixLLT().diagonal().array().square();
    if (cholesky.info() != Eigen::Success || !(pivots > smallestPivot*matrix.diagonal().array()).all()) return false;
    Eigen::Map<Eigen::VectorXd>(x, n) = cholesky.solve(Eigen::Map<const Eigen::VectorXd>(b, n));
    return true;
}

}
