"""Run two models on a task from Python, and print their scores."""

from pathlib import Path

from rich.console import Console

from mocapbench import benchmark as bench


def main() -> None:
    """Plan the jobs, run them on two workers, and print the scores."""
    request = bench.Request("smoke", tasks=("toy-interpolation-1",), models=("linear", "knn"))
    jobs = bench.plan(request, bench.archive_at())
    about = {**bench.provenance(["run_from_python.py"], 1), "profile": request.profile, "seed": "0"}
    config = bench.WorkerConfig(
        folders=(), plugins=(), timeout=600.0, memory=4 * 2**30, threads=1, provenance=about
    )
    store = bench.RunDirectory.create(Path("from-python"))
    store.save_plan(bench.plan_document(jobs, workers=2, task_files=[], provenance=about))
    with bench.ThisMachine(n_workers=2) as backend:
        records = bench.run(jobs, store, config, backend=backend, console=Console())
    print(bench.score_table(records)[["label", "fold", "metric", "value"]])


if __name__ == "__main__":
    main()
