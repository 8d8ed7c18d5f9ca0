"""Hollow spheres: Lame's under pressure, and Goodier's spherical cavity under remote tension"""
import numpy as np

from solution import Solution, rows


def to_cylindrical(r, z, radial, meridional, radial_stress, meridional_stress, hoop_stress, shear):
    """Components along R and phi (angle from the z axis) to r, z, theta"""
    size = np.sqrt(r**2 + z**2)
    s, c = r/size, z/size
    displacement = rows(r, z, radial*s + meridional*c, radial*c - meridional*s, 0.0)
    stress = rows(r, z, radial_stress*s**2 + meridional_stress*c**2 + 2*shear*s*c,
                  radial_stress*c**2 + meridional_stress*s**2 - 2*shear*s*c, hoop_stress,
                  (radial_stress - meridional_stress)*s*c + shear*(c**2 - s**2), 0.0, 0.0)
    return displacement, stress


def hollow_sphere(material, inner, outer, pressure):
    """Lame: pressure inside"""
    young, nu = material.young, material.poisson
    a = pressure*inner**3/(outer**3 - inner**3)
    b = a*outer**3

    def fields(r, z):
        size = np.sqrt(r**2 + z**2)
        radial = ((1 - 2*nu)*a*size + (1 + nu)*b/(2*size**2))/young
        return to_cylindrical(r, z, radial, 0.0, a - b/size**3, a + b/(2*size**3),
                              a + b/(2*size**3), 0.0)

    return Solution("hollow sphere", 0, material, lambda r, z: fields(r, z)[0],
                    lambda r, z: fields(r, z)[1], region=(0.1*outer, outer, 0.1*outer, outer),
                    surface=[("stress", np.float64(0.0), np.float64(inner), 1, -pressure),
                             ("stress", np.float64(0.0), np.float64(outer), 1, 0.0)])


def spherical_cavity(material, radius, tension):
    """Goodier 1933: cavity in a body under uniform tension along z far away"""
    young, nu, g = material.young, material.poisson, material.shear
    unit = tension/(8*g*(7 - 5*nu))
    a, b, c = -unit*(13 - 10*nu)*radius**3, unit*radius**5, unit*5*(1 - 2*nu)*radius**3
    n = 1 - 2*nu

    def fields(r, z):
        size = np.sqrt(r**2 + z**2)
        cosine, sine = (z**2 - r**2)/size**2, 2*r*z/size**2
        near, far = 1/size**3, 1/size**5
        radial = size*(-a*near - 3*b*far + ((5 - 4*nu)/n*c*near - 9*b*far)*cosine)
        meridional = -size*(2*c*near + 6*b*far)*sine
        sigma = 2*g*np.array([
            2*a*near - 2*nu/n*c*near + 12*b*far + (-2*(5 - nu)/n*c*near + 36*b*far)*cosine,
            -a*near - 2*nu/n*c*near - 3*b*far + (c*near - 21*b*far)*cosine,
            -a*near - 2*(1 - nu)/n*c*near - 9*b*far + (3*c*near - 15*b*far)*cosine,
            (-2*(1 + nu)/n*c*near + 24*b*far)*sine])
        return to_cylindrical(r, z, radial, meridional, *sigma)

    def displacement(r, z):
        return fields(r, z)[0] + tension/young*rows(r, z, -nu*r, z, 0.0)

    def stress(r, z):
        return fields(r, z)[1] + tension*rows(r, z, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0)

    half = np.float64(radius*np.sqrt(0.5))
    return Solution("spherical cavity", 0, material, displacement, stress,
                    region=(0.8*radius, 3*radius, 0.8*radius, 3*radius),
                    surface=[("stress", np.float64(0.0), np.float64(radius), 1, 0.0),
                             ("stress", np.float64(radius), np.float64(0.0), 0, 0.0),
                             ("stress", np.float64(radius), np.float64(0.0), 1,
                              tension*(27 - 15*nu)/(2*(7 - 5*nu)))]
                    + [("stress", half, half, 3, -stress(half, half)[0])])
