/* Plain FASTSIM (Kalker 1982, parabolic bound, midpoints): the yardstick of benchmarks/contact.py. */
#include <math.h>

void fastsim(double a, double b, double limit, double nu_x, double nu_y, double phi,
             const double *flexibility, int cells, int strips, double *force)
{
    double dy = 2.0 * b / strips, fx = 0.0, fy = 0.0, mz = 0.0;
    double peak = 2.0 * limit / (M_PI * a * b);
    for (int j = 0; j < strips; j++) {
        double y = -b + (j + 0.5) * dy, half = a * sqrt(1.0 - y * y / (b * b));
        double dx = 2.0 * half / cells, qx = 0.0, qy = 0.0;
        for (int i = 0; i < cells; i++) {
            double x = half - (i + 0.5) * dx;
            qx -= dx * (nu_x / flexibility[0] - phi * y / flexibility[2]);
            qy -= dx * (nu_y / flexibility[1] + phi * x / flexibility[2]);
            double bound = peak * (1.0 - x * x / (a * a) - y * y / (b * b));
            double size = sqrt(qx * qx + qy * qy);
            if (size > bound) {
                qx *= bound / size;
                qy *= bound / size;
            }
            fx += qx * dx * dy;
            fy += qy * dx * dy;
            mz += (x * qy - y * qx) * dx * dy;
        }
    }
    force[0] = fx;
    force[1] = fy;
    force[2] = mz;
}

double repeat(int times, double a, double b, double limit, const double *flexibility, int cells,
              int strips)
{
    double force[3], sum = 0.0;
    for (int i = 0; i < times; i++) {
        fastsim(a, b, limit, 1e-3 + 1e-9 * i, 2e-3, 0.3, flexibility, cells, strips, force);
        sum += force[0];
    }
    return sum;
}
