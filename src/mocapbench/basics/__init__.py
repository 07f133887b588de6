"""What every part needs: names of arrays, gaps, checks of numbers, words, whole files, one thread of BLAS."""
