% Predict hidden channels from those that are visible in the same frame, as jointly Gaussian.
function gaussian (step, folder)
  learnt = fullfile (folder, 'model', 'moments.mat');
  if strcmp (step, 'fit')
    frames = [];
    for file = dir (fullfile (folder, 'train', '*.mat'))'
      recording = load (fullfile (folder, 'train', file.name));
      frames = [frames; recording.values];
    end
    frames = frames(all (~isnan (frames), 2), :);
    centre = sum (frames, 1) / size (frames, 1);
    covariance = cov (frames) + 1e-6 * eye (size (frames, 2));
    save (learnt, 'centre', 'covariance', '-v7');
    return
  end
  load (learnt, 'centre', 'covariance');
  for file = dir (fullfile (folder, 'given', '*.mat'))'
    recording = load (fullfile (folder, 'given', file.name));
    mean = recording.values;
    std = zeros (size (mean));
    for n = 1:size (mean, 1)
      seen = ~isnan (mean(n, :));
      weights = covariance(~seen, seen) / covariance(seen, seen);
      mean(n, ~seen) = centre(~seen) + (mean(n, seen) - centre(seen)) * weights';
      left = covariance(~seen, ~seen) - weights * covariance(seen, ~seen);
      std(n, ~seen) = sqrt (diag (left));
    end
    save (fullfile (folder, 'filled', file.name), 'mean', 'std', '-v7');
  end
end
