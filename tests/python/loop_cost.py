"""What a loop of Python costs: seconds of the processor for the main scene, row by row with a driven chuck, over those of
Scene.run(). From the root of the project: PYTHONPATH=build/release/python python3 tests/python/loop_cost.py"""

import time

import debond

scene = debond.Scene("prm/paper/main_scene.prm", {"Output/Fields every": "none"})
n = 1000


def loop():
    simulation = debond.Simulation(scene, drive={"Press": 0, "Rotation z": 0})
    for t in [0, 1] + [1 + (i + 1) / n for i in range(n)]:
        simulation.advance({"Press": 0.0049 * min(t, 1), "Rotation z": 10 * max(t - 1, 0)})
        assert abs(simulation.row["time"] - t) < 1e-9
    return simulation.result()


seconds = {loop: [], scene.run: []}
for _ in range(5):
    for run, times in seconds.items():
        start = time.process_time()
        run()
        times.append(time.process_time() - start)
print(f"{min(seconds[loop]) / min(seconds[scene.run]):.3f}")
