"""The largest of sums of harmonics, anywhere round the circle and at any of many points."""
import numpy as np

from ..circle import SYMMETRIC, mode_factors

# Angles at which points are looked at first: the fewest, and for each wave of the highest harmonic
LEAST_ANGLES, ANGLES_OF_A_WAVE = 72, 16
# Points of the largest amplitudes that say what others must exceed; values at once; Newton steps from an angle
FIRST, BLOCK, STEPS = 64, 2**20, 5
# A share of the largest sum of sizes of amplitudes by which values differ by rounding
ROUNDING = 1e-13
# Modes of which all amplitudes are a smaller share of it are rounding
SLIGHT = 1e-16


class Waves:
    """Sums of harmonics of one component, or of some that are a vector, whose length counts.

    amplitude: (modes, points, components); around: of each component whether it goes round the axis, as w and the stresses
    r-theta and z-theta do
    """

    def __init__(self, harmonic, family, amplitude, around):
        amplitude = np.where(np.isfinite(amplitude), amplitude, 0.0)
        size = np.linalg.norm(amplitude, axis=-1)
        tells = size.max(axis=1, initial=0) > SLIGHT*size.sum(axis=0).max(initial=0)
        harmonic, family, amplitude, size = (one[tells] for one in (harmonic, family, amplitude, size))
        self.harmonic, self.family, self.amplitude, self.around = harmonic, family, amplitude, np.asarray(around)
        self.bound, self.bend = size.sum(axis=0), harmonic.astype(float)**2 @ size  # of values, of second derivatives
        self.noise = ROUNDING*self.bound.max(initial=0) + np.finfo(float).tiny
        highest = int(harmonic.max(initial=0))
        count = max(LEAST_ANGLES, ANGLES_OF_A_WAVE*highest) if highest else 1
        even = (family == SYMMETRIC).all() and (amplitude.shape[-1] > 1 or not around[0])
        self.step, self.angles = 360/count, np.arange(count//2 + 1 if even else count)*360/count
        # Half a step from where it is largest a sum has lost at most this times its second derivative, which is at most
        # that of the highest harmonic with the size of the sum
        self.loss = np.radians(self.step)**2/8
        self.steepest = highest**2/(1 - self.loss*highest**2)

    def largest(self, sign=1):
        """Value, point and angle [degree] of the largest; of one component it may be that of its negative, sign -1.

        Of equal ones it is that of the first point, at the first angle.
        """
        peak = (self._sampled(sign, np.argsort(-self.bound)[:FIRST]).max() - 2*self.noise, None, None)
        near = []
        chosen = np.flatnonzero(self.bound > peak[0])
        for points in np.array_split(chosen, len(self.angles)*len(chosen)//BLOCK + 1):
            points = points[self.bound[points] > peak[0]]
            values = self._sampled(sign, points)
            peak = self._higher(peak, values.T, points[:, None], self.angles)
            gain = self.loss*np.minimum(self.bend[points], self.steepest*abs(values).max(axis=0))
            point, angle = np.nonzero((values + gain > peak[0] + self.noise).T)
            near.append((points[point], self.angles[angle], (values + gain)[angle, point]))
        near = [np.concatenate(one) for one in zip(*near)]
        for first in range(0, len(near[0]), BLOCK//64):
            points, theta, most = (one[first:first + BLOCK//64] for one in near)
            left = most > peak[0] + self.noise
            peak = self._higher(peak, *self._climbed(sign, points[left], theta[left]))
        return sign*peak[0], peak[1], peak[2] % 360

    def _higher(self, peak, values, points, theta):
        """The first of the largest values where they exceed a peak by more than rounding, else the peak."""
        if values.max(initial=-np.inf) <= peak[0] + self.noise:
            return peak
        first = np.unravel_index((values >= values.max() - self.noise).argmax(), values.shape)
        return tuple(np.broadcast_to(one, values.shape)[first] for one in (values, points, theta))

    def _sampled(self, sign, points):
        """Values at all angles: (angles, points)."""
        factors = mode_factors(self.harmonic, self.family, self.angles)
        parts = [factors[int(around)] @ self.amplitude[:, points, k] for k, around in enumerate(self.around)]
        return sign*parts[0] if len(parts) == 1 else np.sqrt(sum(part**2 for part in parts))

    def _climbed(self, sign, points, theta):
        """The largest values within half a step of angles, points and angles of them, by Newton's method."""
        largest, where, tried = np.full(len(theta), -np.inf), theta, theta
        for _ in range(STEPS):
            value, slope, bend = self._derivatives(sign, points, tried)
            better = value > largest + self.noise
            largest, where = np.where(better, value, largest), np.where(better, tried, where)
            step = np.where(bend < 0, -slope/np.where(bend < 0, bend, 1), np.sign(slope)*self.step)
            tried = np.clip(tried + np.degrees(step), theta - self.step/2, theta + self.step/2)
        return largest, points, where

    def _derivatives(self, sign, points, theta):
        """Values of points at an angle each, and first and second derivatives: of a length those of half its square."""
        along, across = mode_factors(self.harmonic, self.family, theta)
        m, amplitude = self.harmonic, self.amplitude[:, points]
        factors = np.where(self.around, along[..., None]*0 + across[..., None], along[..., None])
        slopes = np.where(self.around, (m*along)[..., None], (-m*across)[..., None])
        x, d, dd = (np.einsum("mpc,pmc->pc", amplitude, one) for one in (factors, slopes, -(m**2)[:, None]*factors))
        if len(self.around) == 1:
            return sign*x[:, 0], sign*d[:, 0], sign*dd[:, 0]
        return np.linalg.norm(x, axis=1), (x*d).sum(1), (d*d + x*dd).sum(1)
