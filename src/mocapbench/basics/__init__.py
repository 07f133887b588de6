"""What every part needs: arrays, gaps, numbers, words, whole files, and one thread of BLAS."""
