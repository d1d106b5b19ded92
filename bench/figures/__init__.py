"""Makes the tables, plots and images of documents and reports from results of the benches and from the program."""
