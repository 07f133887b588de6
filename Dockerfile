# mocapbench in a container. From a clone:
#
#     docker build --tag mocapbench .
#     docker run --rm --user "$(id -u):$(id -g)" --volume "$PWD:/data" mocapbench
#
# The second line runs the benchmark and writes mocapbench-results/report.html into the current
# folder. Another command stands after the name: `… mocapbench fill walk.csv`.
FROM python:3.13-slim AS build
WORKDIR /clone
COPY pyproject.toml README.md LICENSE ./
COPY src src
COPY datasets datasets
COPY metrics metrics
COPY baselines baselines
COPY reports reports
COPY benchmark benchmark
RUN pip wheel --no-cache-dir --no-deps --wheel-dir /wheels .

FROM python:3.13-slim
COPY --from=build /wheels /wheels
RUN pip install --no-cache-dir "$(echo /wheels/mocapbench-*.whl)[figures,parquet,xlsx]"
# Whoever runs it may write into the folder that is mounted, and into no other.
ENV MOCAPBENCH_CACHE=/data/mocapbench-cache MPLCONFIGDIR=/tmp/matplotlib
USER 65534:65534
WORKDIR /data
ENTRYPOINT ["mocapbench"]
CMD ["run"]
