# Fill each channel with the mean of its visible values, in Julia without packages.
using DelimitedFiles, Statistics
step, folder = ARGS # the step is always "fill"
for name in readdir(joinpath(folder, "given"))
    values = readdlm(joinpath(folder, "given", name, "values.csv"), ',', Float64)
    for channel in eachcol(values)
        channel[isnan.(channel)] .= mean(filter(!isnan, channel))
    end
    mkdir(joinpath(folder, "filled", name))
    writedlm(joinpath(folder, "filled", name, "mean.csv"), values, ',')
end
