//! Values of parameters.

/// A value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A list of numbers.
    Numbers(Vec<f64>),
    /// A whole number.
    Whole(usize),
    /// Numbers of things.
    Counts(Vec<usize>),
    /// One of the words of the parameter.
    Word(&'static str),
    /// A list of pairs of numbers.
    Pairs(Vec<[f64; 2]>),
    /// A list of vectors.
    Vectors(Vec<[f64; 3]>),
    /// Values of parameters of its own.
    Table(Values),
    /// A list of them.
    Tables(Vec<Values>),
}

/// Values of parameters by their names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Values(Vec<(&'static str, Value)>);

impl Values {
    /// Returns the values with one more.
    pub fn with(mut self, name: &'static str, value: impl Into<Value>) -> Self {
        self.0.push((name, value.into()));
        self
    }

    /// Returns the values with others behind them.
    pub fn followed_by(mut self, others: Self) -> Self {
        self.0.extend(others.0);
        self
    }

    /// Returns the values with a number, if there is one.
    pub fn with_any(self, name: &'static str, number: Option<f64>) -> Self {
        match number {
            Some(number) => self.with(name, number),
            None => self,
        }
    }

    /// Returns a value, if it is there.
    pub fn get(&self, name: &str) -> Option<&Value> {
        let mut all = self.0.iter();
        all.find(|(known, _)| *known == name)
            .map(|(_, value)| value)
    }

    /// Returns all values in their order.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &Value)> {
        self.0.iter().map(|(name, value)| (*name, value))
    }

    /// Returns a number that may be absent.
    pub fn number_if_any(&self, name: &str) -> Option<f64> {
        match self.get(name)? {
            Value::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// Returns a number.
    ///
    /// # Panics
    /// When there is none of that name.
    pub fn number(&self, name: &str) -> f64 {
        let found = self.number_if_any(name);
        found.expect("the law declares the number it asks for")
    }

    /// Returns a list of numbers.
    ///
    /// # Panics
    /// When there is none of that name.
    pub fn numbers(&self, name: &str) -> &[f64] {
        let found = self.get(name).and_then(|value| match value {
            Value::Numbers(numbers) => Some(numbers),
            _ => None,
        });
        found.expect("the law declares the list it asks for")
    }

    /// Returns so many numbers.
    ///
    /// # Panics
    /// When there are not that many of that name.
    pub fn array<const N: usize>(&self, name: &str) -> [f64; N] {
        let found = self.numbers(name).try_into();
        found.expect("the law declares as many numbers as it asks for")
    }

    /// Returns so many numbers, if they are there.
    ///
    /// # Panics
    /// When there is another number of them.
    pub fn array_if_any<const N: usize>(&self, name: &str) -> Option<[f64; N]> {
        self.get(name).map(|_| self.array(name))
    }

    /// Returns a whole number.
    ///
    /// # Panics
    /// When there is none of that name.
    pub fn whole(&self, name: &str) -> usize {
        let found = self.get(name).and_then(|value| match value {
            Value::Whole(number) => Some(*number),
            _ => None,
        });
        found.expect("the law declares the whole number it asks for")
    }

    /// Returns so many numbers of things.
    ///
    /// # Panics
    /// When there are not that many of that name.
    pub fn counts<const N: usize>(&self, name: &str) -> [usize; N] {
        let found = self.get(name).and_then(|value| match value {
            Value::Counts(counts) => counts.as_slice().try_into().ok(),
            _ => None,
        });
        found.expect("the law declares as many numbers as it asks for")
    }

    /// Returns a word.
    ///
    /// # Panics
    /// When there is none of that name.
    pub fn word(&self, name: &str) -> &'static str {
        let found = self.get(name).and_then(|value| match value {
            Value::Word(word) => Some(*word),
            _ => None,
        });
        found.expect("the law declares the word it asks for")
    }

    /// Returns pairs of numbers, if they are there.
    pub fn pairs_if_any(&self, name: &str) -> Option<&[[f64; 2]]> {
        match self.get(name)? {
            Value::Pairs(pairs) => Some(pairs),
            _ => None,
        }
    }

    /// Returns a list of vectors.
    ///
    /// # Panics
    /// When there is none of that name.
    pub fn vectors(&self, name: &str) -> &[[f64; 3]] {
        let found = self.get(name).and_then(|value| match value {
            Value::Vectors(vectors) => Some(vectors),
            _ => None,
        });
        found.expect("the law declares the vectors it asks for")
    }

    /// Returns the values of a table.
    ///
    /// # Panics
    /// When there is none of that name.
    pub fn table(&self, name: &str) -> &Self {
        let found = self.table_if_any(name);
        found.expect("the law declares the table it asks for")
    }

    /// Returns the values of a table, if it is there.
    pub fn table_if_any(&self, name: &str) -> Option<&Self> {
        match self.get(name)? {
            Value::Table(values) => Some(values),
            _ => None,
        }
    }

    /// Returns the values of tables, if they are there.
    pub fn tables_if_any(&self, name: &str) -> Option<&[Self]> {
        match self.get(name)? {
            Value::Tables(all) => Some(all),
            _ => None,
        }
    }

    /// Returns the values of tables.
    ///
    /// # Panics
    /// When there are none of that name.
    pub fn tables(&self, name: &str) -> &[Self] {
        let found = self.tables_if_any(name);
        found.expect("the law declares the tables it asks for")
    }
}

impl<const N: usize> From<[(&'static str, f64); N]> for Values {
    fn from(numbers: [(&'static str, f64); N]) -> Self {
        let numbers = numbers.into_iter();
        Self(
            numbers
                .map(|(name, number)| (name, number.into()))
                .collect(),
        )
    }
}

impl FromIterator<(&'static str, Value)> for Values {
    fn from_iter<I: IntoIterator<Item = (&'static str, Value)>>(values: I) -> Self {
        Self(values.into_iter().collect())
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<Vec<f64>> for Value {
    fn from(numbers: Vec<f64>) -> Self {
        Self::Numbers(numbers)
    }
}

impl From<&[f64]> for Value {
    fn from(numbers: &[f64]) -> Self {
        Self::Numbers(numbers.to_vec())
    }
}

impl From<usize> for Value {
    fn from(number: usize) -> Self {
        Self::Whole(number)
    }
}

impl From<&[usize]> for Value {
    fn from(counts: &[usize]) -> Self {
        Self::Counts(counts.to_vec())
    }
}

impl From<Vec<[f64; 2]>> for Value {
    fn from(pairs: Vec<[f64; 2]>) -> Self {
        Self::Pairs(pairs)
    }
}

impl From<Vec<[f64; 3]>> for Value {
    fn from(vectors: Vec<[f64; 3]>) -> Self {
        Self::Vectors(vectors)
    }
}

impl From<[f64; 3]> for Value {
    fn from(vector: [f64; 3]) -> Self {
        Self::Numbers(vector.into())
    }
}

impl From<Values> for Value {
    fn from(values: Values) -> Self {
        Self::Table(values)
    }
}

impl From<Vec<Values>> for Value {
    fn from(all: Vec<Values>) -> Self {
        Self::Tables(all)
    }
}

impl From<&'static str> for Value {
    fn from(word: &'static str) -> Self {
        Self::Word(word)
    }
}
