/* FASTSIM with all strips side by side, as `tramdva.contact.fastsim` marches: the yardstick of
   benchmarks/contact.py. Vector registers hold strips: no strip waits for another, the bound is
   taken without a branch. Compile with -O3 -march=native -ffast-math. */
#include <math.h>

/* Along a strip, from its leading edge: place, weight, step and middle of the step, bound.
   Across: half length, place, weighted area, bound; strips padded with weight zero. */
struct grid {
    int nodes, strips;
    const double *node, *weight, *step, *middle, *bound_along;
    const double *half_length, *offset, *area, *bound_across;
};

static void fastsim(double a, double b, double traction, double nu_x, double nu_y, double phi,
                    double shear, const double *flexibility, const struct grid *grid,
                    double *restrict work, double *force)
{
    const double rate_x = nu_x / flexibility[0], rate_y = nu_y / flexibility[1];
    const double rate_spin = phi / flexibility[2], scale = traction / (a * b);
    const int strips = grid->strips;
    double *restrict qx = work, *restrict qy = work + strips, *restrict drive_x = work + 2 * strips;
    double *restrict drive_y = work + 3 * strips, *restrict limit = work + 4 * strips;
    const double *restrict half_length = grid->half_length, *restrict offset = grid->offset;
    const double *restrict area = grid->area, *restrict bound_across = grid->bound_across;
    for (int j = 0; j < strips; j++) {
        qx[j] = qy[j] = 0.0;
        drive_x[j] = a * half_length[j] * (rate_x - rate_spin * b * offset[j]);
        drive_y[j] = a * half_length[j] * (rate_y + rate_spin * shear * b * offset[j]);
        limit[j] = scale * bound_across[j];
    }
    double force_x = 0.0, force_y = 0.0, moment_x = 0.0, moment_y = 0.0;
    for (int k = 0; k < grid->nodes; k++) {
        const double step = grid->step[k], bound = grid->bound_along[k];
        const double spin_rate = grid->middle[k] * a * a * rate_spin;
        double total_x = 0.0, total_y = 0.0, arm_x = 0.0, arm_y = 0.0;
        for (int j = 0; j < strips; j++) {
            const double half = half_length[j], capacity = bound * limit[j];
            double x = qx[j] - step * drive_x[j];
            double y = qy[j] - step * (drive_y[j] + spin_rate * half * half);
            const double squared = x * x + y * y, most = capacity * capacity;
            const double share = capacity / sqrt(squared > most ? squared : most);
            x *= share;
            y *= share;
            qx[j] = x;
            qy[j] = y;
            total_x += area[j] * x;
            total_y += area[j] * y;
            arm_x += offset[j] * area[j] * (x - shear * y);
            arm_y += half * area[j] * y;
        }
        force_x += grid->weight[k] * total_x;
        force_y += grid->weight[k] * total_y;
        moment_x += grid->weight[k] * arm_x;
        moment_y += grid->weight[k] * grid->node[k] * arm_y;
    }
    force[0] = a * b * force_x;
    force[1] = a * b * force_y;
    force[2] = a * b * (a * moment_y - b * moment_x);
}

double repeat(int times, double a, double b, double traction, const double *flexibility,
              const struct grid *grid, double *work, double *force)
{
    double sum = 0.0;
    for (int i = 0; i < times; i++) {
        fastsim(a, b, traction, 1e-3 + 1e-9 * i, 2e-3, 0.3, 0.0, flexibility, grid, work, force);
        sum += force[0];
    }
    return sum;
}
