"""What every part needs: names of arrays, gaps, checks of numbers, words, and whole files."""
