// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/surfaceTension/pairForce/PairForce.H"

namespace shizuku
{

double forceOfTension(double sigma, double n, double h, double integral)
{
    constexpr double pi = 3.14159265358979323846;
    return 8 * sigma / (pi * n * n * h * h * h * h * h * integral);
}

}
