% Fill each channel by piecewise cubics between its visible values: MATLAB or Octave.
function pchip_gaps (step, folder)  % the step is always 'fill'
  for file = dir (fullfile (folder, 'given', '*.mat'))'
    given = load (fullfile (folder, 'given', file.name));
    mean = given.values;
    for d = 1:size (mean, 2)
      seen = find (~isnan (mean(:, d)));
      at = min (max (given.times, given.times(seen(1))), given.times(seen(end)));
      mean(:, d) = interp1 (given.times(seen), mean(seen, d), at, 'pchip');
    end
    save (fullfile (folder, 'filled', file.name), 'mean', '-v7');
  end
end
