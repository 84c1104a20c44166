import numpy as np
from numpy.testing import assert_allclose

from tramdva.bifurcation.continuation import AlgebraicCurve, CurvePoint, StepControl, trace


def circle(tests=lambda point: {}):
    return AlgebraicCurve(
        lambda z: np.array([z @ z - 1.0]), lambda z: 2.0 * z[None, :], tests, tolerance=1e-12
    )


def test_walks_around_a_circle_through_both_folds():
    curve = circle(lambda point: {"fold": point.tangent[0]})
    start = curve.start(np.array([0.0, 1.0]), np.array([1.0, 0.0]))
    control = StepControl(initial=0.05, smallest=1e-6, largest=0.2, max_points=40)
    branch = trace(curve, start, control)
    points = np.array([point.z for point in branch.points])
    assert_allclose(np.linalg.norm(points, axis=1), 1.0, atol=1e-12)
    assert branch.ended == "max_points"
    folds = np.array([s.point.z for s in branch.special])
    assert_allclose(folds[:2], [[1.0, 0.0], [-1.0, 0.0]], atol=1e-8)


def test_corrector_is_quadratic():
    curve = circle()
    start = curve.start(np.array([0.0, 1.0]), np.array([1.0, 0.0]))
    far, few = (
        curve.correct(curve.predict(start, 0.3))[1],
        curve.correct(curve.predict(start, 0.01))[1],
    )
    assert few <= 2
    assert far <= 4


def test_a_curve_that_ends_is_reported_with_what_was_found():
    # sqrt has no real solutions for x < 0: Newton's method yields NaN there
    curve = AlgebraicCurve(
        lambda z: np.array([np.sqrt(z[0]) - z[1]]),
        lambda z: np.array([[0.5 / np.sqrt(z[0]), -1.0]]),
    )
    start = curve.start(np.array([1.0, 1.0]), np.array([-1.0, 0.0]))
    control = StepControl(initial=0.05, smallest=1e-4, largest=0.05, max_points=1000)
    with np.errstate(invalid="ignore", divide="ignore"):
        branch = trace(curve, start, control)
    assert branch.ended in ("no_convergence", "sharp_turn")
    assert 0.0 <= branch.points[-1].z[0] < 1e-2


def test_a_point_for_which_stop_says_discard_is_left_out():
    curve = circle()
    start = curve.start(np.array([0.0, 1.0]), np.array([1.0, 0.0]))
    control = StepControl(initial=0.1, smallest=1e-6, largest=0.1, max_points=40)

    def stop(point: CurvePoint) -> str | None:
        return "window" if point.z[0] > 0.5 else None

    kept = trace(curve, start, control, stop)
    inside = trace(
        curve, start, control, stop, discard=frozenset({"window"}), approach=frozenset({"window"})
    )
    assert kept.points[-1].z[0] > 0.5 >= inside.points[-1].z[0]
    assert inside.points[-1].z[0] > 0.49  # it came close to the end
    assert kept.ended == inside.ended == "window"
