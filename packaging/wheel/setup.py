"""What a wheel with the program has beside that of python/pyproject.toml: a platform, and any Python 3"""
from setuptools import Distribution, setup
from wheel.bdist_wheel import bdist_wheel


class Platform(Distribution):
    """A distribution that is not the same on all platforms"""

    def has_ext_modules(self):
        return True


class Wheel(bdist_wheel):
    """No module is compiled, so every Python 3 will do"""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


setup(distclass=Platform, cmdclass={"bdist_wheel": Wheel})
