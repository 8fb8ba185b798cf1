# SPDX-License-Identifier: MIT
"""Kills the swallow again and again, resumes it, and compares it to the bit with a run that nobody disturbed. Checks
that it is not resumed where files that it needs are lost or tracks of the past have changed, and that two runs never
write into one folder.

Usage: check_resume.py PROGRAM [KILLS | FITTED]. Ends with 1 and a message at the first difference. KILLS: how often it
is killed at a random moment (default: 3). FITTED: the fitted.bin of an earlier run; a run on these particles is killed
and resumed once.
"""
import json
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

program = sys.argv[1]
DATA = pathlib.Path(__file__).resolve().parents[3] / "examples/swallowing/data"
extra = sys.argv[2] if len(sys.argv) > 2 else "3"
fitted = None if extra.isdigit() else pathlib.Path(extra)
SETTINGS = ["--case", "X1", "--until", "0.045", "--frame-interval", "0.015"]  # a checkpoint comes every 0.02 s
if fitted:
    SETTINGS = ["--case", "X1", "--until", "0.021", "--frame-interval", "0.01", "--particles", "fitted",
                "--no-surfaces"]
MEASURED = ("wall_seconds", "particle_steps_per_second", "contact_share", "contact_share_per_tenth", "threads")


def command(out, *options):
    return [program, *SETTINGS, "--out", str(out), *options]


def run(out, *options):
    subprocess.run(command(out, *options), check=True, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)


def kill_behind_checkpoint(out, age, *options):
    """Starts the program and kills it `age` seconds after it wrote its next checkpoint."""
    checkpoint = out / "X1/checkpoint.bin"
    before = checkpoint.stat().st_mtime_ns if checkpoint.exists() else None
    with subprocess.Popen(command(out, *options), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL) as process:
        while process.poll() is None and (not checkpoint.exists() or checkpoint.stat().st_mtime_ns == before):
            time.sleep(0.001)
        time.sleep(age)
        if process.poll() is not None:
            sys.exit("the run ended before it was killed: nothing was tested")
        process.kill()


def results(out):
    """All that a run leaves, without what it measured of the machine."""
    folder = out / "X1"
    found = {str(f.relative_to(folder)): f.read_bytes() for f in folder.rglob("*")
             if f.suffix in (".csv", ".pvd", ".vtu", ".png") or f.parent.name == "snapshots"}
    state = (folder / "checkpoint.bin").read_bytes()
    found["checkpoint.bin"] = state[:state.rindex(b"seconds")]
    summary = json.loads((folder / "summary.json").read_text())
    return found | {key: value for key, value in summary.items() if key not in MEASURED}


def compare(what, whole, other, but=()):
    a, b = results(whole), results(other)
    different = sorted(name for name in (a.keys() | b.keys()) - set(but) if a.get(name) != b.get(name))
    if different:
        sys.exit(f"{what}: {different} differ")
    print(f"{what}: {len(a)} results are the same to the bit", flush=True)


def kill_at_random(out, most):
    """Starts the program and kills it at most `most` seconds later. Returns whether it was still running."""
    with subprocess.Popen(command(out, "--resume"), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL) as process:
        try:
            process.wait(timeout=random.uniform(0, most))
        except subprocess.TimeoutExpired:
            process.kill()
            return True
    if process.returncode != 0:
        sys.exit(f"a killed run was resumed and ended with {process.returncode}")
    return False


def refused(out, *parts, options=("--resume",)):
    """The program ends with 2 and a message that holds the parts, and leaves the series as it is."""
    series = out / "X1/series.csv"
    before = series.read_bytes() if series.exists() else None
    result = subprocess.run(command(out, *options), capture_output=True, text=True, check=False)
    if result.returncode != 2 or any(part not in result.stderr for part in parts):
        sys.exit(f"{parts}: ended with {result.returncode}: {result.stderr}")
    if (series.read_bytes() if series.exists() else None) != before:
        sys.exit(f"{parts}: series.csv was changed")


def refuses_what_is_incomplete(whole, out):
    """Resumes a copy of a whole run of which something is missing."""
    def lose(path, left=None):
        shutil.rmtree(out, ignore_errors=True)
        shutil.copytree(whole, out)
        content = (out / "X1" / path).read_bytes()
        (out / "X1" / path).unlink()
        if left is not None:
            (out / "X1" / path).write_bytes(content[:int(left * len(content))])

    lose("series.csv")
    refused(out, "series.csv", "start anew without --resume")
    lose("series.csv", 0.5)
    refused(out, "series.csv", "start anew without --resume")
    lose("frames/frame_00001.vtu")
    refused(out, "frame_00001.vtu", "--no-frames")
    lose("surfaces/surface_00000.vtu")
    refused(out, "surface_00000.vtu", "--no-frames")
    lose("frames.pvd", 0.3)
    refused(out, "frames.pvd", "--no-frames")
    lose("snapshots/snapshot_0.000s.bin")
    refused(out, "snapshots", "0 s", "start anew without --resume")
    lose("checkpoint.bin")
    refused(out, "checkpoint.bin", "start anew without --resume")
    shutil.rmtree(out)
    print("what is incomplete is not resumed", flush=True)


def follows_other_tracks_from_here(whole, out, data):
    """Tracks may differ in what is to come, not in what has been: resumes a copy of a run with such tracks."""
    shutil.copytree(DATA, data)
    tracks = data / "constrictors.csv"
    given = tracks.read_text()
    if given.count(",1.85,2.05,") != 1:
        sys.exit("constrictors.csv has changed: change this check too")
    tracks.write_text(given.replace(",1.85,2.05,", ",1.84,2.05,"))
    shutil.copytree(whole, out)
    run(out, "--data", str(data), "--resume")
    # What it wrote says so: it is now a run of these tracks. With those of the beginning it may go on as well.
    compare("resumed with tracks that differ only later", whole, out, but=("checkpoint.bin", "settings"))
    run(out, "--resume")
    compare("resumed with the first tracks again", whole, out)

    tongue = data / "tongue.csv"
    given = tongue.read_text()
    if given.count("\n7,0.5,") != 1:
        sys.exit("tongue.csv has changed: change this check too")
    tongue.write_text(given.replace("\n7,0.5,", "\n7,0.49,"))
    refused(out, "checkpoint.bin", "content of", options=("--data", str(data), "--resume"))
    shutil.rmtree(out)


def refuses_a_folder_in_use(out):
    """While one run writes into a folder, another is refused at once; when it has been killed, the next may go on."""
    with subprocess.Popen(command(out), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL) as process:
        while process.poll() is None and not (out / "X1/series.csv").exists():
            time.sleep(0.001)
        process.send_signal(signal.SIGSTOP)  # so that it does not end meanwhile
        result = subprocess.run(command(out, "--resume"), capture_output=True, text=True, check=False)
        if result.returncode != 2 or str(process.pid) not in result.stderr:
            sys.exit(f"a second run in one folder ended with {result.returncode}: {result.stderr}")
        process.kill()
    run(out, "--resume")
    print("of two runs in one folder the second is refused", flush=True)


def check_lattice(alone, killed, data):
    start = time.monotonic()
    run(alone, "--threads", "1")
    seconds = time.monotonic() - start
    kill_behind_checkpoint(killed, 0.0, "--threads", "2")
    kill_behind_checkpoint(killed, 0.02, "--threads", "1", "--resume")
    # What a kill may leave: half a line of the series, half a file beside a whole one.
    with open(killed / "X1/series.csv", "ab") as series:
        series.write(b"0.0412,63.")
    (killed / "X1/checkpoint.bin.part").write_bytes(b"half")
    run(killed, "--threads", "2", "--resume")
    (killed / "X1/checkpoint.bin.part").unlink(missing_ok=True)
    compare("killed twice, resumed with another number of threads", alone, killed)
    run(killed, "--resume")
    compare("resumed at its end", alone, killed)

    shutil.rmtree(killed)
    random.seed(16)
    done = sum(kill_at_random(killed, seconds) for _ in range(int(extra)))
    run(killed, "--resume")
    for part in killed.rglob("*.part"):
        part.unlink()
    compare(f"killed {done} times at random moments", alone, killed)

    shutil.rmtree(killed)
    follows_other_tracks_from_here(alone, killed, data)
    refuses_what_is_incomplete(alone, killed)
    refuses_a_folder_in_use(killed)
    compare("resumed after the run in the same folder was killed", alone, killed)


def check_fitted(alone, killed):
    for out in (alone, killed):
        out.mkdir()
        shutil.copy(fitted, out)  # without --resume, the organs would be fitted again
    run(alone, "--threads", "2", "--resume")
    kill_behind_checkpoint(killed, 0.0, "--threads", "2", "--resume")
    run(killed, "--threads", "1", "--resume")
    (killed / "X1/checkpoint.bin.part").unlink(missing_ok=True)
    compare("fitted particles, killed and resumed with another number of threads", alone, killed)


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    if fitted:
        check_fitted(folder / "alone", folder / "killed")
    else:
        check_lattice(folder / "alone", folder / "killed", folder / "data")
