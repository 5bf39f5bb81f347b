#include "models/surfaceTension/pairTension/CohesionSpline.H"

namespace shizuku
{

double cohesionCoefficient(double sigma, double density, double support)
{
    // int_0^1 C r^4 in units of h^2, by the midpoint rule: the spline is smooth but for one kink.
    constexpr int n = 20000;
    const CohesionSpline C{1};
    double integral = 0;
    for (int i = 0; i < n; ++i)
    {
        const double q = (i + 0.5) / n;
        integral += C(float(q)) * q * q * q * q / n;
    }
    constexpr double pi = 3.14159265358979323846;
    return 8 * sigma / (pi * density * density * support * support * integral);
}

}
