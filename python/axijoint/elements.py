"""Shape functions of the elements, and natural coordinates of points.

All functions work on many points at once: `natural` has the shape (points, 2). Nodes are ordered as
in the result file: corners counterclockwise, mid-sides (the first between corners 1 and 2), centre.
"""
import numpy as np

# Natural coordinates of the nodes of a quadrilateral and of a triangle
SQUARE = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0), (0, 0)], float)
TRIANGLE = np.array([(0, 0), (1, 0), (0, 1), (.5, 0), (.5, .5), (0, .5)])
# Points this far outside, in natural coordinates, count as inside: those of cards have few digits
MARGIN = 1e-6
MOST_STEPS = 30
LAST_STEP = 1e-10
# Where Newton's method starts: the middle, then four points around it
SQUARE_STARTS = np.array([(0, 0), (-.6, -.6), (.6, -.6), (.6, .6), (-.6, .6)])
TRIANGLE_STARTS = np.array([(1/3, 1/3), (.1, .1), (.8, .1), (.1, .8)])


def corners(size):
    """Number of corners of an element of 3, 4, 6, 8 or 9 nodes."""
    return 3 if size in (3, 6) else 4


def edges(size):
    """Nodes of each edge, in order along it: pairs, or triples with the node in the middle."""
    n = corners(size)
    ends = [(i, (i + 1) % n) for i in range(n)]
    return [(a, n + i, b) if size > n else (a, b) for i, (a, b) in enumerate(ends)]


def shape_functions(size, natural):
    """Shape functions (points, size) and their derivatives (points, size, 2) by the natural coordinates."""
    x, y = np.moveaxis(np.asarray(natural, float), -1, 0)
    return {3: _linear_triangle, 6: _quadratic_triangle, 4: _bilinear, 8: _serendipity,
            9: _biquadratic}[size](x, y)


def line_functions(count, x):
    """Shape functions (points, count) and their derivatives at points x of a line of 2 or 3 nodes at equal distances."""
    x = np.asarray(x, float)
    if count == 2:
        return np.stack([(1 - x)/2, (1 + x)/2], -1), np.broadcast_to([-0.5, 0.5], (len(x), 2))
    return np.stack([x*(x - 1)/2, 1 - x**2, x*(x + 1)/2], -1), np.stack([x - 0.5, -2*x, x + 0.5], -1)


def _area_coordinates(x, y):
    area = np.stack([1 - x - y, x, y], -1)
    slope = np.array([(-1., -1.), (1., 0.), (0., 1.)])
    return area, slope


def _linear_triangle(x, y):
    area, slope = _area_coordinates(x, y)
    return area, np.broadcast_to(slope, (len(x), 3, 2))


def _quadratic_triangle(x, y):
    area, slope = _area_coordinates(x, y)
    following = np.roll(area, -1, axis=-1)
    value = np.concatenate([area*(2*area - 1), 4*area*following], -1)
    sides = 4*(area[..., None]*np.roll(slope, -1, axis=0) + following[..., None]*slope)
    return value, np.concatenate([(4*area - 1)[..., None]*slope, sides], -2)


def _bilinear(x, y):
    a, b = SQUARE[:4].T
    x, y = x[:, None], y[:, None]
    return (1 + a*x)*(1 + b*y)/4, np.stack([a*(1 + b*y)/4, b*(1 + a*x)/4], -1)


def _serendipity(x, y):
    x, y = x[:, None], y[:, None]
    a, b = SQUARE[:4].T
    corner = (1 + a*x)*(1 + b*y)*(a*x + b*y - 1)/4
    corner_x, corner_y = a*(1 + b*y)*(2*a*x + b*y)/4, b*(1 + a*x)*(a*x + 2*b*y)/4
    b = SQUARE[[4, 6], 1]  # sides y = -1 and y = 1
    flat, flat_x, flat_y = (1 - x**2)*(1 + b*y)/2, -x*(1 + b*y), b*(1 - x**2)/2
    a = SQUARE[[5, 7], 0]  # sides x = 1 and x = -1
    steep, steep_x, steep_y = (1 + a*x)*(1 - y**2)/2, a*(1 - y**2)/2, -y*(1 + a*x)

    def ordered(at_corners, on_flat, on_steep):
        sides = np.stack([on_flat, on_steep], -1).reshape(len(at_corners), 4)
        return np.concatenate([at_corners, sides], -1)
    return (ordered(corner, flat, steep),
            np.stack([ordered(corner_x, flat_x, steep_x), ordered(corner_y, flat_y, steep_y)], -1))


def _biquadratic(x, y):
    def line(t):  # at -1, 0, 1
        return (np.stack([t*(t - 1)/2, 1 - t**2, t*(t + 1)/2], -1),
                np.stack([t - .5, -2*t, t + .5], -1))
    i, j = SQUARE.astype(int).T + 1
    (fx, dx), (fy, dy) = line(x), line(y)
    return fx[:, i]*fy[:, j], np.stack([dx[:, i]*fy[:, j], fx[:, i]*dy[:, j]], -1)


def find_natural(nodes, position):
    """Natural coordinates of points, by Newton's method.

    nodes: r and z of the nodes of each point's element, (points, size, 2); position: r and z, (points, 2).
    Returns the natural coordinates (points, 2), nan outside, and whether each point is in its element.
    """
    nodes, position = np.asarray(nodes, float), np.asarray(position, float)
    triangle = corners(nodes.shape[1]) == 3
    natural = np.full(position.shape, np.nan)
    inside = np.zeros(len(position), bool)
    for start in TRIANGLE_STARTS if triangle else SQUARE_STARTS:
        left = np.flatnonzero(~inside)
        if not left.size:
            break
        found = _put_inside(triangle, _approach(nodes[left], position[left], start))
        hit = ~np.isnan(found[:, 0])
        natural[left[hit]] = found[hit]
        inside[left[hit]] = True
    return natural, inside


def _approach(nodes, position, start):
    """Newton's method from one start; nan where it does not converge."""
    natural = np.tile(start, (len(position), 1))
    moving = np.arange(len(position))
    done = np.zeros(len(position), bool)
    for _ in range(MOST_STEPS):
        value, derivative = shape_functions(nodes.shape[1], natural[moving])
        gap = position[moving] - np.einsum("pn,pni->pi", value, nodes[moving])
        jacobian = np.einsum("pni,pnk->pik", nodes[moving], derivative)
        (a, b), (c, d) = jacobian[:, 0].T, jacobian[:, 1].T
        determinant = a*d - b*c
        sound = np.abs(determinant) > np.finfo(float).eps*np.abs(jacobian).max(axis=(1, 2))**2
        step = np.stack([d*gap[:, 0] - b*gap[:, 1], a*gap[:, 1] - c*gap[:, 0]], -1)[sound]
        step /= determinant[sound][:, None]
        moving = moving[sound]
        length = np.abs(step).max(axis=1, initial=0)
        natural[moving] += step/np.maximum(length, 1)[:, None]
        done[moving[length < LAST_STEP]] = True
        moving = moving[length >= LAST_STEP]
        if not moving.size:
            break
    natural[~done] = np.nan
    return natural


def _put_inside(triangle, natural):
    """Points outside by rounding are moved to the edge; the others outside become nan."""
    with np.errstate(invalid="ignore"):
        if triangle:
            inside = np.minimum(natural.min(axis=1), 1 - natural.sum(axis=1)) >= -MARGIN
            natural = np.maximum(natural, 0)
            natural = natural/np.maximum(1, natural.sum(axis=1))[:, None]
        else:
            inside = np.abs(natural).max(axis=1) <= 1 + MARGIN
            natural = np.clip(natural, -1, 1)
    natural[~inside] = np.nan
    return natural
