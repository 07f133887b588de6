"""What every part needs: names of arrays, checks of numbers, words, and files written whole."""
