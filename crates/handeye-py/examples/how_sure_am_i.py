"""How sure a calibration is, and whether that is true: many simulated cells, and what each states of itself."""

import json
import pathlib
import tempfile

import numpy as np

import handeye


def main() -> None:
    normalised, stated, true = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(1, 13):
            cell = pathlib.Path(folder) / f"cell_{seed}"
            handeye.simulate(cell, setup="eye-in-hand", seed=seed, captures=15, images=False)
            found = handeye.calibrate(cell)
            if not found.accepted:
                print(seed, found.verdict, found.reasons)
                continue
            truth = json.loads((cell / "truth.json").read_text())["mount_from_camera"]
            known = handeye.Pose(
                "flange", "camera", rotation=truth["rotation_xyzw"], translation=truth["translation_m"]
            )
            off = known.inverse() @ found.pose
            error = np.append(off.rotation_vector, off.translation)
            normalised.append(error @ np.linalg.solve(found.covariance, error) / 6)
            stated.append(np.linalg.norm(found.sigma[1]))
            true.append(1e3 * np.linalg.norm(off.translation))
    print(f"stated {np.mean(stated):.2f} mm, true {np.mean(true):.2f} mm (means over {len(true)} cells)")
    print(f"squared error over what was stated: {np.mean(normalised):.2f} (1 is right, more is too sure)")
    assert len(true) >= 10 and np.mean(normalised) < 3


if __name__ == "__main__":
    main()
