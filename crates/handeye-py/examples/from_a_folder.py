"""From a folder of pictures and robot poses to a transform with a report.

    python from_a_folder.py CELL [OUT]

Without a folder, one is simulated, with known truth.
"""

import json
import pathlib
import sys
import tempfile

import handeye


def main() -> None:
    given = [pathlib.Path(word) for word in sys.argv[1:]]
    folder = given[0] if given else pathlib.Path(tempfile.mkdtemp()) / "cell"
    if not given:
        handeye.simulate(folder, setup="eye-to-hand", captures=10, width=960, height=600, scans=True)

    def tell(done: int, count: int) -> None:
        print(f"\r{done} of {count} captures", end="", flush=True)

    calibration = handeye.calibrate(folder, out=given[1] if len(given) > 1 else folder / "result", progress=tell)
    print(f"\n{calibration.verdict}: {'; '.join(calibration.reasons)}")
    for candidate in calibration.candidates:
        print(f"  {candidate.name:20} predicted error {candidate.predicted_tre_mm} mm")
    if not calibration.accepted:
        sys.exit("not to be used")
    print(calibration.pose)
    print(calibration.predicted_tre_mm)
    calibration.export("urdf", folder)

    truth_file = folder / "truth.json"
    if truth_file.exists():
        truth = json.loads(truth_file.read_text())["mount_from_camera"]
        off = handeye.Pose("base", "camera", rotation=truth["rotation_xyzw"], translation=truth["translation_m"])
        off = off.inverse() @ calibration.pose
        error_mm = 1e3 * float((off.translation**2).sum()) ** 0.5
        print(f"off the truth by {error_mm:.3f} mm")
        assert error_mm < 3.0


if __name__ == "__main__":
    main()
