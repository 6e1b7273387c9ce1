# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A command with a log, a timeout, and an end: when it is over, or this process
is gone, nothing of it is left running."""

import ctypes
import os
import resource
import signal
import subprocess
import time

PR_SET_PDEATHSIG = 1


def die_with_parent(is_parent):
    """Be killed when the process that started this one ends (Linux), or at once
    where that has ended already: isParent(pid) says whether this parent is the
    one."""
    ctypes.CDLL(None, use_errno=True).prctl(
        PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0
    )
    if not is_parent(os.getppid()):
        os._exit(1)


def started_here():
    """For preexec_fn: die with this process."""
    here = os.getpid()
    return lambda: die_with_parent(lambda pid: pid == here)


def guard(group):
    """A process beside the command that outlives this one just long enough to
    kill the command's process group. Returns what ends it: (pid, pipe)."""
    read, write = os.pipe()
    pid = os.fork()
    if pid:
        os.close(read)
        return pid, write
    try:
        os.setsid()
        os.close(write)
        # Not the files of the process it guards, such as its locks
        os.closerange(3, read)
        os.closerange(read + 1, 256)
        if os.read(read, 1) == b"":
            os.killpg(group, signal.SIGKILL)
    except OSError:
        pass
    finally:
        os._exit(0)


def run(command, folder, log, timeout=None, environment=None):
    """Run a bash command in a folder, its output in the log. Returns the exit
    status, None after a timeout, and wall and processor time [s]."""
    start, used = time.monotonic(), processor_time()
    with open(log, "w") as output:
        process = subprocess.Popen(
            ["bash", "-c", command],
            cwd=folder,
            stdout=output,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            start_new_session=True,
            preexec_fn=started_here(),
            env={**os.environ, "PWD": str(folder), **(environment or {})},
        )
        pid, pipe = guard(process.pid)
        try:
            status = process.wait(timeout)
        except subprocess.TimeoutExpired:
            status = None
        finally:
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            process.wait()
            os.write(pipe, b".")
            os.close(pipe)
            os.waitpid(pid, 0)
    return status, time.monotonic() - start, processor_time() - used


def processor_time():
    """Of all processes started from here that have ended [s]."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime
