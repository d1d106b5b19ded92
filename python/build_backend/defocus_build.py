"""Build backend of pyproject.toml: scikit-build-core. If that package is missing, lists what the build needs."""

try:
    from scikit_build_core.build import *  # noqa: F403
    from scikit_build_core.build import build_wheel  # noqa: F401
except ImportError:
    MISSING = (
        "defocus: `pip install .` needs the Python packages scikit-build-core (0.5 or later), pybind11 and numpy, and --no-build-isolation; "
        "scripts/dependencies lists the libraries. Without scikit-build-core, build with: cmake -S . -B build/python -DDEFOCUS_PYTHON=ON && "
        "cmake --build build/python -t defocus_python && cmake --install build/python --component python")

    def build_wheel(*_arguments, **_options):
        raise SystemExit(MISSING)

    build_sdist = prepare_metadata_for_build_wheel = build_wheel
