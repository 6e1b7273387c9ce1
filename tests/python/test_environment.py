# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""On a machine whose user has sourced an OpenFOAM, that one is used and nothing
is installed. Source of truth: the README's section "Two commands".
"""

import os
import pathlib
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture
def machine(tmp_path):
    """An environment with somebody's OpenFOAM, and an apt-get that tells."""
    programs = tmp_path / "bin"
    programs.mkdir()
    for name in ("apt-get", "sudo"):
        (programs / name).write_text(f"#!/bin/sh\ntouch '{tmp_path}/called'\n")
        (programs / name).chmod(0o755)
    return {
        "PATH": f"{programs}:/usr/bin:/bin",
        "HOME": str(tmp_path),
        "WM_PROJECT_DIR": str(tmp_path / "OpenFOAM-v2312"),
        "WM_PROJECT_VERSION": "v2312",
        "WM_OPTIONS": "linux64GccDPInt32Opt",
    }


def bash(command, environment):
    return subprocess.run(
        ["bash", "-c", command],
        cwd=ROOT,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )


def test_a_sourced_openfoam_stays_and_ours_is_added(machine):
    done = bash(
        ". etc/bashrc && echo $WM_PROJECT_DIR && echo $PATH"
        " && echo $LD_LIBRARY_PATH",
        machine,
    )
    project, path, libraries = done.stdout.decode().split()
    assert project == machine["WM_PROJECT_DIR"]
    ours = f"{ROOT}/build/{machine['WM_OPTIONS']}"
    assert f"{ours}/bin" in path.split(":")
    assert f"{ours}/lib" in libraries.split(":")
    assert "noLink" not in path


def test_where_an_openfoam_is_sourced_nothing_is_installed(machine, tmp_path):
    done = bash("bin/needPackages a-package-nobody-has", machine)
    assert done.returncode == 0
    assert b"a-package-nobody-has" in done.stdout
    assert not (tmp_path / "called").exists()


def test_without_one_missing_packages_are_installed(machine, tmp_path):
    del machine["WM_PROJECT_DIR"], machine["WM_PROJECT_VERSION"]
    bash("bin/needPackages a-package-nobody-has", machine)
    assert (tmp_path / "called").exists()


@pytest.mark.parametrize("version", ["10", "4.1", "dev"])
def test_another_openfoam_is_refused(machine, tmp_path, version):
    done = bash("./Allwmake", {**machine, "WM_PROJECT_VERSION": version})
    assert done.returncode == 1
    assert b"openfoam.com" in done.stdout
    assert not (tmp_path / "called").exists()


def test_a_python_is_found_that_has_what_is_needed():
    done = bash("bin/python3With json csv", dict(os.environ))
    assert done.returncode == 0
    done = bash("bin/python3With no_such_module", dict(os.environ))
    assert done.returncode == 1
    assert b"no_such_module" in done.stdout


def test_tutorials_take_their_environment_from_one_place():
    # Which knows of the installed package, where nothing is to be compiled
    scripts = [
        path
        for path in (ROOT / "tutorials").glob("*/All*")
        if path.parent.name != "include"
    ]
    assert len(scripts) > 30
    for script in scripts:
        text = script.read_text()
        assert "etc/bashrc" not in text, script
        if "Allwmake" in text:
            assert "-e ../../Allwmake" in text, script


def test_a_tutorial_that_is_nowhere_says_so(tmp_path):
    for part in ("tutorials/include", "tutorials/ffd2D"):
        shutil.copytree(
            ROOT / part,
            tmp_path / part,
            ignore=shutil.ignore_patterns("runs", "results", "log.*"),
        )
    if pathlib.Path("/usr/share/morphfoam/etc/bashrc").exists():
        pytest.skip("the package is installed here")
    done = bash(
        f"{tmp_path}/tutorials/ffd2D/Allrun", {"PATH": "/usr/bin:/bin"}
    )
    assert done.returncode == 1
    assert b"neither in ../.. nor installed" in done.stdout


@pytest.fixture
def source_tree(machine, tmp_path):
    """A copy of what Allwmake needs, objects of former builds, and a wmake
    that compiles nothing."""
    root = tmp_path / "morphFoam"
    root.mkdir()
    for name in ("Allwmake", "VERSION", "etc"):
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, root / name)
    (tmp_path / "eigen/Eigen").mkdir(parents=True)
    (tmp_path / "eigen/Eigen/Dense").touch()
    machine["EIGEN_INC"] = str(tmp_path / "eigen")
    wmake = tmp_path / "bin/wmake"
    wmake.write_text("#!/bin/sh\n[ $1 != -show-cxx ] || echo $CXX_OF_WMAKE\n")
    wmake.chmod(0o755)
    for folder in (
        "Make",
        "applications/a/Make",
        "benchmarks/b/Make",
        "src/catalyst/Make",
        "tests/programs/c/Make",
    ):
        for options in (machine["WM_OPTIONS"], "linux64ClangDPInt32Opt"):
            (root / folder / options).mkdir(parents=True)
            (root / folder / options / "a.o").touch()
    return root


def build(root, environment, **variables):
    """Run Allwmake: what it printed, and the objects of this machine's options
    that are still there."""
    done = subprocess.run(
        ["bash", "./Allwmake"],
        cwd=root,
        env={**environment, **variables},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        check=True,
    )
    return done.stdout.decode(), sorted(
        root.glob(f"**/{environment['WM_OPTIONS']}/a.o")
    )


def test_objects_of_another_openfoam_are_not_used(machine, source_tree):
    """wmake tells them apart by WM_OPTIONS, which has no version in it."""
    root = source_tree
    assert build(root, machine)[1] == []
    kept = root / "Make" / machine["WM_OPTIONS"] / "a.o"
    kept.parent.mkdir()
    kept.touch()
    library = root / "build" / machine["WM_OPTIONS"] / "lib/library.so"
    library.parent.mkdir()
    library.touch()
    assert build(root, machine)[1] == [kept] and library.exists()
    assert build(root, machine, WM_PROJECT_VERSION="v2512")[1] == []
    assert not library.exists()
    # What has other options is told apart already
    assert len(list(root.glob("**/linux64ClangDPInt32Opt/a.o"))) == 5


def test_a_patched_openfoam_is_another(machine, source_tree):
    api = pathlib.Path(machine["WM_PROJECT_DIR"]) / "META-INFO/api-info"
    api.parent.mkdir(parents=True)
    kept = source_tree / "Make" / machine["WM_OPTIONS"] / "a.o"
    for patch, objects in (("0", []), ("0", [kept]), ("230612", [])):
        api.write_text(f"api=2312\npatch={patch}\n")
        assert build(source_tree, machine)[1] == objects
        kept.parent.mkdir(exist_ok=True)
        kept.touch()


@pytest.mark.parametrize("compiler, found", [("true", True), ("false", False)])
def test_blas_is_looked_for_with_the_compiler_of_wmake(
    machine, source_tree, compiler, found
):
    said, _ = build(source_tree, machine, CXX_OF_WMAKE=compiler)
    assert ("without OpenBLAS" not in said) == found


def test_lists_of_headers_that_are_gone_are_made_anew(machine, source_tree):
    """make stops at them. A header's path is relative to the folder of Make, or
    absolute; one of OpenFOAM's begins with a variable."""
    root = source_tree
    build(root, machine)
    (root / "lnInclude").mkdir()
    (root / "lnInclude/here.H").touch()
    (root / "lnInclude/moved.H").symlink_to("nowhere.H")
    lists = {
        "here": "lnInclude/here.H",
        "gone": "src/foam/gone.hpp",
        "moved": "lnInclude/moved.H",
        "openFOAM": "$(WM_PROJECT_DIR)/a.H",
        "absolute": f"{root}/lnInclude/gone.H",
        "there": f"{root}/lnInclude/here.H",
    }
    objects = root / "Make" / machine["WM_OPTIONS"] / "src/foam"
    objects.mkdir(parents=True)
    for name, header in lists.items():
        (objects / f"{name}.C.dep").write_text(
            f"$(OBJECTS_DIR)/{name}.C.dep: \\\nAllwmake \\\n{header} \\\n\n"
        )
    build(root, machine)
    assert sorted(path.name for path in objects.glob("*.dep")) == [
        "here.C.dep",
        "openFOAM.C.dep",
        "there.C.dep",
    ]
